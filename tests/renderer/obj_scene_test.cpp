// Bare OBJ scenes: shapes per material, lights that face the scene, camera, headlight, warnings.
#include "renderer/obj_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "tests/renderer/temp_files.h"

namespace octolux {
namespace {

/// Of a scene that is not completed.
const Bsdf& bsdf_of(const Scene& scene, std::size_t shape) {
  return *scene.bsdfs.at(static_cast<std::size_t>(scene.shapes.at(shape).bsdf));
}

/// A room of 2 x 2 x 2 m, open at +z, and a lamp below its ceiling; `lamp` is the lamp's face line.
std::string room(const std::string& lamp) {
  return "mtllib room.mtl\n"
         "v -1 0 -1\nv 1 0 -1\nv 1 2 -1\nv -1 2 -1\nv -1 0 1\nv 1 0 1\nv 1 2 1\nv -1 2 1\n"
         "v -.2 1.9 -.2\nv .2 1.9 -.2\nv .2 1.9 .2\nv -.2 1.9 .2\n"
         "usemtl wall\nf 1 2 3 4\nf 1 5 6 2\nf 4 3 7 8\n"
         "usemtl lamp\n" +
         lamp + "\nusemtl wall\nf 1 4 8 5\nf 2 6 7 3\n";
}
const char kRoomMtl[] =
    "newmtl wall\nKd 0.7 0.6 0.5\nnewmtl lamp\nKe 17 12 4\nnewmtl unused\nfoo 1\n";

std::unique_ptr<Scene> load(const std::string& obj, const std::string& mtl = kRoomMtl) {
  const test::TempFolder folder;
  if (!mtl.empty()) folder.write("room.mtl", mtl);
  auto scene = std::make_unique<Scene>();
  load_obj_scene(folder.write("room.obj", obj), *scene);
  return scene;
}

int warnings_about(const Scene& scene, const std::string& text) {
  return static_cast<int>(
      std::count_if(scene.warnings.begin(), scene.warnings.end(),
                    [&](const std::string& w) { return w.find(text) != std::string::npos; }));
}

TEST(ObjScene, OneShapePerMaterial) {
  const auto scene = load(room("f 9 10 11 12"));
  ASSERT_EQ(scene->shapes.size(), 2u);
  EXPECT_EQ(scene->shapes[0].name, "wall");
  EXPECT_EQ(primitive_count(scene->shapes[0]), 10u);
  EXPECT_EQ(scene->shapes[1].name, "lamp");
  EXPECT_TRUE(std::get<TriangleMesh>(scene->shapes[0].geometry).normals.empty()) << "flat";
  EXPECT_EQ(scene->shapes[0].light, -1);
  EXPECT_EQ(scene->shapes[1].light, 0);
  const auto rho = bsdf_of(*scene, 0).lambertian({}, {0, 0, -1});
  ASSERT_TRUE(rho.has_value());
  EXPECT_EQ(*rho, Rgb(0.7f, 0.6f, 0.5f));
  EXPECT_EQ(warnings_about(*scene, "unknown key 'foo'"), 1);
}

TEST(ObjScene, LampsShineIntoTheSceneWhicheverWayTheyAreWound) {
  for (const char* lamp : {"f 9 10 11 12", "f 12 11 10 9", "vn 0 1 0\nf 9//1 10//1 11//1 12//1",
                           "vn 0 -1 0\nf 9//1 10//1 11//1 12//1"}) {
    SCOPED_TRACE(lamp);
    const auto scene = load(room(lamp));
    ASSERT_EQ(scene->lights.size(), 1u);
    const auto down = scene->lights[0]->sample({0, 1, 0}, {0.5f, 0.5f});
    ASSERT_TRUE(down.has_value());
    EXPECT_EQ(down->radiance, Rgb(17, 12, 4));
    EXPECT_FALSE(scene->lights[0]->sample({0, 1.95f, 0}, {0.5f, 0.5f}).has_value());
    const float power = kPi * 17 * 0.4f * 0.4f;
    EXPECT_NEAR(scene->lights[0]->power().r, power, power * 16 * 0x1p-23f);
  }
  EXPECT_EQ(warnings_about(*load(room("f 9 10 11 12")), "turned round"), 0);
  EXPECT_EQ(warnings_about(*load(room("f 12 11 10 9")), "2 triangles faced away"), 1);
}

TEST(ObjScene, BulbsKeepTheirOutside) {
  // A tetrahedron as a soup of triangles that share positions, not indices; far from the middle.
  const std::string bulb =
      "v 5 0 0\nv 5 1 0\nv 6 0 0\nv 5 0 1\n"
      "f -4 -3 -2\nv 5 0 0\nv 6 0 0\nv 5 0 1\nf -3 -2 -1\nv 5 0 0\nv 5 0 1\nv 5 1 0\nf -3 -2 -1\n"
      "v 6 0 0\nv 5 1 0\nv 5 0 1\nf -3 -2 -1\n";
  const auto scene = load(room(bulb));
  EXPECT_EQ(warnings_about(*scene, "turned round"), 0);
  EXPECT_EQ(primitive_count(scene->shapes[1]), 4u);
}

TEST(ObjScene, CameraLooksIntoBoxesOpenTowardsIt) {
  auto scene = load(room("f 9 10 11 12"));
  const Camera camera(scene->camera_config, scene->film);
  const float edge = 256 / 1.05f;  // the front face's half width [pixels]
  const auto at_front = [&](float x, float y) {
    const Ray ray = camera.ray({256 + x, 256 + y});
    return ray.origin + ray.direction * ((1 - ray.origin.z) / ray.direction.z);
  };
  EXPECT_EQ(scene->film.width, 512);
  EXPECT_EQ(scene->film.crop_height, 512);
  const float tolerance = 1e-5f;  // some roundings of coordinates up to 4
  const Vec3 center = at_front(0, 0), right = at_front(edge, 0), up = at_front(0, -edge);
  EXPECT_NEAR(center.x, 0, tolerance);
  EXPECT_NEAR(center.y, 1, tolerance);
  EXPECT_NEAR(right.x, 1, tolerance);
  EXPECT_NEAR(right.y, 1, tolerance);
  EXPECT_NEAR(up.x, 0, tolerance);
  EXPECT_NEAR(up.y, 2, tolerance);
  EXPECT_LT(camera.forward().z, -0.999f);
  EXPECT_LT(scene->camera_config.near_clip, camera.ray({256, 256}).origin.z - 1);
  EXPECT_GT(scene->camera_config.far_clip, camera.ray({256, 256}).origin.z + 1);
  EXPECT_EQ(warnings_about(*scene, "placed one at"), 1);
  EXPECT_EQ(warnings_about(*scene, "point light"), 0);
}

TEST(ObjScene, AHeadlightIfNothingEmits) {
  const auto scene = load("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n", "");
  ASSERT_EQ(scene->lights.size(), 1u);
  const auto light = scene->lights[0]->sample({0, 0, 0}, {0.5f, 0.5f});
  ASSERT_TRUE(light.has_value());
  // Radiance of a white Lambertian at the middle of the model: E / pi.
  EXPECT_NEAR(light->radiance.g / kPi, 0.5f, 0.5f * 16 * 0x1p-23f);
  EXPECT_NEAR(light->wi.z, 1, 0x1p-22f);
  EXPECT_EQ(warnings_about(*scene, "nothing emits light: placed a point light"), 1);
}

TEST(ObjScene, MissingMaterials) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto scene = load(
      "mtllib gone.mtl\n" + square + "f 1 2 3\nusemtl nobody\nf 1 3 4\nusemtl b\nf 1 2 4\n", "");
  EXPECT_EQ(scene->shapes.size(), 3u);
  EXPECT_EQ(warnings_about(*scene, "gone.mtl: material file not found"), 1);
  EXPECT_EQ(warnings_about(*scene, "material 'nobody' is not defined"), 1);
  EXPECT_EQ(warnings_about(*scene, "faces without a material are grey"), 1);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(bsdf_of(*scene, i).lambertian({}, {0, 0, 1}).value(), Rgb(0.5f));
    EXPECT_EQ(scene->shapes[i].bsdf, scene->shapes[0].bsdf);
  }
}

TEST(ObjScene, MaterialFilesByEveryKindOfName) {
  for (const char* name : {"a b.mtl", "gone.mtl a\\ b.mtl", "./a b.mtl", " a b.mtl "}) {
    SCOPED_TRACE(name);
    const test::TempFolder folder;
    folder.write("a b.mtl", "newmtl m\nKd 0.25 0.25 0.25\n");
    Scene scene;
    load_obj_scene(folder.write("x y.obj", std::string("mtllib ") + name +
                                               "\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl m\nf 1 2 3\n"),
                   scene);
    EXPECT_EQ(bsdf_of(scene, 0).lambertian({}, {0, 0, 1}).value(), Rgb(0.25f));
  }
}

TEST(ObjScene, HashCoversBothFiles) {
  const std::string lamp = "f 9 10 11 12";
  const std::uint64_t a = load(room(lamp))->hash;
  EXPECT_EQ(load(room(lamp))->hash, a);
  EXPECT_NE(load(room(lamp) + "#")->hash, a);
  EXPECT_NE(load(room(lamp), std::string(kRoomMtl) + "#")->hash, a);
}

TEST(ObjScene, DegenerateTriangles) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const auto scene = load(v + "f 1 2 3\nf 1 1 2\nusemtl line\nf 1 2 2\n", "");
  EXPECT_EQ(scene->shapes.size(), 1u);
  EXPECT_EQ(warnings_about(*scene, "2 triangles without area are left out"), 1);
  EXPECT_NE(test::message_of<Error>([&] { load(v + "f 1 1 2\n", ""); }).find("have no area"),
            std::string::npos);
}

}  // namespace
}  // namespace octolux
