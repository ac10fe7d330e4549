// Mesh files of scene files: options of all formats, attributes, names that differ in case, files
// that are missing, parameters of exporters.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

/// Two triangles that share an edge at a right angle, without normals; red, green and blue corners.
const std::string kFold =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty float color_r\nproperty float color_g\nproperty float color_b\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0 0 1\n0 0 1 2 0 0\n3 0 1 2\n3 0 3 1\n";

std::string scene(const std::string& parameters, const std::string& file = "fold.ply",
                  const std::string& type = "ply") {
  return "<scene version='3.0.0'><sensor type='perspective'/>\n<shape type='" + type +
         "'><string name='filename' value='" + file + "'/>" + parameters + "</shape></scene>";
}

class XmlMeshFiles : public testing::Test {
 protected:
  void SetUp() override { files_.write("Meshes/fold.ply", kFold); }
  TriangleMesh load(const std::string& parameters) {
    files_.write("scene.xml", scene(parameters, "Meshes/fold.ply"));
    return std::get<TriangleMesh>(files_.load()->shapes.at(0).geometry);
  }
  std::string complaint(const std::string& text) {
    files_.write("scene.xml", text);
    return files_.error();
  }
  SceneFiles files_;
};

bool is_one_of_the_faces(Vec3 n) { return n == Vec3{0, 0, 1} || n == Vec3{0, 1, 0}; }

TEST_F(XmlMeshFiles, NormalsAreSmoothUnlessToldOtherwise) {
  const TriangleMesh smooth = load("");
  ASSERT_EQ(smooth.normals.size(), 4u);
  EXPECT_NEAR(smooth.normals[0].y, std::sqrt(0.5f), 1e-6f);
  EXPECT_NEAR(smooth.normals[0].z, std::sqrt(0.5f), 1e-6f);
  EXPECT_TRUE(load("<boolean name='faceNormals' value='true'/>").normals.empty());
  EXPECT_TRUE(load("<boolean name='face_normals' value='true'/>").normals.empty());
}

TEST_F(XmlMeshFiles, CreasesSharperThanTheAngleStay) {
  const TriangleMesh sharp = load("<float name='maxSmoothAngle' value='80'/>");
  ASSERT_EQ(sharp.positions.size(), 6u);  // the common edge has two vertices at each end
  for (const Vec3 n : sharp.normals) EXPECT_TRUE(is_one_of_the_faces(n));
  const TriangleMesh smooth = load("<float name='max_smooth_angle' value='100'/>");
  EXPECT_EQ(smooth.positions.size(), 4u);
  EXPECT_FALSE(is_one_of_the_faces(smooth.normals[0]));
}

TEST_F(XmlMeshFiles, FlippingTurnsNormalsAndWinding) {
  const TriangleMesh mesh = load("<boolean name='flipNormals' value='true'/>");
  EXPECT_LT(mesh.normals[0].z, 0);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 2, 1}));
}

TEST_F(XmlMeshFiles, MirroredMeshesKeepTheirFront) {
  const TriangleMesh mesh = load("<transform name='to_world'><scale z='-1'/></transform>");
  EXPECT_LT(surface_point(mesh, 0, 0.2f, 0.2f).ng.z, 0);
}

TEST_F(XmlMeshFiles, TexturesReadAttributes) {
  for (const char* texture : {"<texture type='mesh_attribute' name='reflectance'>"
                              "<string name='name' value='vertex_color'/></texture>",
                              "<texture type='vertexcolors' name='reflectance'/>"}) {
    files_.write("scene.xml", scene("<bsdf type='diffuse'>" + std::string(texture) + "</bsdf>",
                                    "Meshes/fold.ply"));
    const auto loaded = files_.load();
    const auto& mesh = std::get<TriangleMesh>(loaded->shapes[0].geometry);
    const SurfacePoint point = surface_point(mesh, 0, 0.25f, 0.5f);
    const Rgb albedo =
        loaded->bsdfs.at(static_cast<std::size_t>(loaded->shapes[0].bsdf))->albedo(point);
    EXPECT_NEAR(albedo.r, 0.25f, 1e-6f);
    EXPECT_NEAR(albedo.g, 0.25f, 1e-6f);
    EXPECT_NEAR(albedo.b, 0.5f, 1e-6f);
    ASSERT_GE(loaded->warnings.size(), 1u);
    EXPECT_NE(loaded->warnings[0].find("outside [0, 1]; clamped"), std::string::npos);
  }
  EXPECT_TRUE(load("").attributes.empty());  // nobody asked
}

TEST_F(XmlMeshFiles, AttributesThatAreNotThereAreErrors) {
  const std::string bsdf =
      "<bsdf type='diffuse'><texture type='mesh_attribute' name='reflectance'>"
      "<string name='name' value='face_color'/></texture></bsdf>";
  EXPECT_NE(complaint(scene(bsdf, "Meshes/fold.ply")).find("unknown mesh attribute 'face_color'"),
            std::string::npos);
  EXPECT_NE(complaint("<scene><sensor type='perspective'/><shape type='cube'>" + bsdf +
                      "</shape></scene>")
                .find("a shape 'cube' has no mesh attribute 'face_color'"),
            std::string::npos);
}

TEST_F(XmlMeshFiles, NamesMayDifferInCase) {
  files_.write("scene.xml", scene("", "meshes\\FOLD.ply"));
  const auto loaded = files_.load();
  EXPECT_EQ(std::get<TriangleMesh>(loaded->shapes[0].geometry).triangles.size(), 2u);
  ASSERT_FALSE(loaded->warnings.empty());
  EXPECT_NE(loaded->warnings[0].find("Meshes/fold.ply' is used"), std::string::npos);
}

TEST_F(XmlMeshFiles, MissingFilesAreErrorsOrLeftOut) {
  const std::string text =
      "<scene version='3.0.0'><sensor type='perspective'/><shape type='cube'/>\n"
      "<shape type='obj'><string name='filename' value='none.obj'/></shape></scene>";
  EXPECT_NE(complaint(text).find("scene.xml:2: file not found: 'none.obj'"), std::string::npos);
  Scene loaded;
  load_xml_scene(files_.path(), {.skip_missing = true}, loaded);
  EXPECT_EQ(loaded.shapes.size(), 1u);
  EXPECT_NE(loaded.warnings.at(0).find("is left out"), std::string::npos);
}

TEST_F(XmlMeshFiles, BadOptions) {
  EXPECT_NE(complaint(scene("<float name='max_smooth_angle' value='30'/>"
                            "<boolean name='face_normals' value='true'/>",
                            "Meshes/fold.ply"))
                .find("give either 'face_normals' or 'max_smooth_angle'"),
            std::string::npos);
  EXPECT_NE(complaint(scene("<float name='max_smooth_angle' value='-1'/>", "Meshes/fold.ply"))
                .find("between 0 and 180"),
            std::string::npos);
  EXPECT_NE(
      complaint(scene("<integer name='shape_index' value='-1'/>", "Meshes/fold.ply", "serialized"))
          .find("must not be negative"),
      std::string::npos);
}

TEST_F(XmlMeshFiles, TheFirstBadFileOfTheSceneIsNamedWhateverTheThreads) {
  std::string text = "<scene><sensor type='perspective'/>";
  for (int i = 0; i < 30; ++i) {
    const std::string name = "m" + std::to_string(i) + ".ply";
    files_.write(name, i < 7 ? kFold : "ply\n" + std::string(static_cast<std::size_t>(i), 'x'));
    text += "<shape type='ply'><string name='filename' value='" + name + "'/></shape>";
  }
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_NE(complaint(text + "</scene>").find("m7.ply:2:"), std::string::npos);
  }
}

TEST_F(XmlMeshFiles, OneFileManyShapes) {
  std::string text = "<scene><sensor type='perspective'/>";
  for (int i = 0; i < 5; ++i) {
    text +=
        "<shape type='ply'><string name='filename' value='Meshes/fold.ply'/>"
        "<transform name='to_world'><translate x='" +
        std::to_string(i) + "'/></transform></shape>";
  }
  files_.write("scene.xml", text + "</scene>");
  const auto first = files_.load(), second = files_.load();
  EXPECT_EQ(first->hash, second->hash);
  for (int i = 0; i < 5; ++i) {
    const auto& mesh =
        std::get<TriangleMesh>(first->shapes.at(static_cast<std::size_t>(i)).geometry);
    EXPECT_EQ(mesh.positions[0].x, static_cast<float>(i));
  }
  files_.write("Meshes/fold.ply", kFold + "\n");
  EXPECT_NE(files_.load()->hash, first->hash);
}

TEST_F(XmlMeshFiles, WhatExportersAddIsIgnoredOnce) {
  const auto loaded = load_text(
      "<scene><sensor type='perspective'><vector name='min_bounds' value='0,0,0'/></sensor>"
      "<shape type='cube'><vector name='min_bounds' value='0,0,0'/></shape>"
      "<bsdf type='conductor'><boolean name='usePathGuiding' value='false'/></bsdf></scene>");
  int bounds = 0, guiding = 0;
  for (const std::string& w : loaded->warnings) {
    bounds += w.find("'min_bounds' is ignored") != std::string::npos;
    guiding += w.find("'use_path_guiding' is ignored") != std::string::npos;
  }
  EXPECT_EQ(bounds, 1);
  EXPECT_EQ(guiding, 1);
  EXPECT_NE(complaint("<scene><sensor type='perspective'><vector name='min_bound' "
                      "value='0,0,0'/></sensor><shape type='cube'/></scene>")
                .find("unknown perspective parameter 'min_bound'"),
            std::string::npos);
}

TEST_F(XmlMeshFiles, IntegratorsThatAreKnownAreChecked) {
  const auto text = [](const std::string& type) {
    return "<scene><sensor type='perspective'/><shape type='cube'/><integrator type='" + type +
           "'><integer name='max_dept' value='3'/><integer name='rr_depth' value='5'/>"
           "</integrator></scene>";
  };
  EXPECT_NE(complaint(text("path")).find("(did you mean 'max_depth'?)"), std::string::npos);
  EXPECT_EQ(complaint(text("guidedpath")), "");
}

}  // namespace
}  // namespace octolux::test
