// Shapes of scene files, and the emitters on and beside them.
#include <gtest/gtest.h>

#include <string>

#include "core/constants.h"
#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

const TriangleMesh& mesh_of(const Scene& scene) {
  return std::get<TriangleMesh>(scene.shapes.at(0).geometry);
}

std::unique_ptr<Scene> load_shape(const std::string& type, const std::string& parameters) {
  return load_text("<scene><sensor type='perspective'/><shape type='" + type + "'>" + parameters +
                   "</shape></scene>");
}

Vec3 triangle_normal(const TriangleMesh& mesh, std::size_t i) {
  const auto& t = mesh.triangles[i];
  const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
  return normalize(cross(b - a, c - a));
}

TEST(XmlShape, RectangleFacesPlusZWithTextureFromItsLowerLeft) {
  const auto scene = load_shape("rectangle", "");
  const TriangleMesh& mesh = mesh_of(*scene);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(area(scene->shapes[0]), 4, 1e-6);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(triangle_normal(mesh, i), (Vec3{0, 0, 1}));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_EQ(mesh.uvs[i].x, (mesh.positions[i].x + 1) / 2);
    EXPECT_EQ(mesh.uvs[i].y, (mesh.positions[i].y + 1) / 2);
  }
}

TEST(XmlShape, MirroringKeepsTheFrontAndFlippingTurnsIt) {
  const char* mirror = "<transform name='to_world'><scale x='-1'/></transform>";
  const char* flip = "<boolean name='flip_normals' value='true'/>";
  const auto normal = [](const std::string& parameters) {
    return triangle_normal(mesh_of(*load_shape("rectangle", parameters)), 0);
  };
  EXPECT_EQ(normal(mirror), (Vec3{0, 0, 1}));
  EXPECT_EQ(normal(flip), (Vec3{0, 0, -1}));
  EXPECT_EQ(normal(std::string(mirror) + flip), (Vec3{0, 0, -1}));
}

TEST(XmlShape, CubeFacesOutwardsEvenMirrored) {
  for (const char* parameters :
       {"", "<transform name='to_world'><scale x='-2' y='3' z='1'/></transform>"}) {
    const auto scene = load_shape("cube", parameters);
    const TriangleMesh& mesh = mesh_of(*scene);
    ASSERT_EQ(mesh.triangles.size(), 12u);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (std::size_t i = 0; i < 12; ++i) {
      const Vec3 corner = mesh.positions[mesh.triangles[i][0]];
      EXPECT_GT(dot(triangle_normal(mesh, i), corner), 0);
    }
  }
  EXPECT_NEAR(area(load_shape("cube", "")->shapes[0]), 24, 1e-5);
}

TEST(XmlShape, SphereTakesCenterAndRadiusThenToWorld) {
  const auto scene = load_shape("sphere",
                                "<point name='center' x='1'/><float name='radius' value='2'/>"
                                "<transform name='to_world'><scale value='10'/></transform>");
  const auto& q = std::get<Quadric>(scene->shapes[0].geometry);
  EXPECT_EQ(q.kind, Quadric::Kind::sphere);
  EXPECT_EQ(q.to_world.point({0, 0, 0}), (Vec3{10, 0, 0}));
  EXPECT_EQ(q.to_world.point({0, 1, 0}), (Vec3{10, 20, 0}));
}

TEST(XmlShape, CylinderRunsFromP0ToP1) {
  const auto scene =
      load_shape("cylinder",
                 "<point name='p0' value='1, 2, 3'/><point name='p1' value='1, 7, 3'/>"
                 "<float name='radius' value='0.5'/>");
  const auto& q = std::get<Quadric>(scene->shapes[0].geometry);
  EXPECT_EQ(q.kind, Quadric::Kind::cylinder);
  EXPECT_EQ(q.to_world.point({0, 0, 0}), (Vec3{1, 2, 3}));
  EXPECT_EQ(q.to_world.point({0, 0, 1}), (Vec3{1, 7, 3}));
  EXPECT_NEAR(length(q.to_world.vector({1, 0, 0})), 0.5f, 1e-6f);
  EXPECT_GT(q.to_world.determinant(), 0);
}

TEST(XmlShape, EmittersMayBeSharedByReference) {
  const auto scene = load_text(
      "<scene><sensor type='perspective'/>"
      "<shape type='rectangle'><ref id='e'/></shape><shape type='sphere'><ref id='e'/></shape>"
      "<emitter type='area' id='e'><rgb name='radiance' value='1'/></emitter></scene>");
  ASSERT_EQ(scene->lights.size(), 2u);
  // Power pi * area * radiance of the two.
  EXPECT_NEAR(scene->lights[scene->shapes[0].light]->power().r, 4 * kPi, 1e-4f);
  EXPECT_NEAR(scene->lights[scene->shapes[1].light]->power().r, 4 * kPi * kPi, 1e-2f);
}

TEST(XmlEmitter, PointAndConstant) {
  const auto scene = load_text(
      scene_with("<emitter type='point'><point name='position' x='-4' y='0.0' z='6'/>"
                 "<rgb name='intensity' value='300'/></emitter><emitter type='constant'/>"));
  ASSERT_EQ(scene->lights.size(), 2u);
  EXPECT_NEAR(scene->lights[0]->power().g, 300 * 4 * kPi, 1e-2f);
  ASSERT_EQ(scene->environment.size(), 1u);
  EXPECT_EQ(scene->environment[0]->radiance({0, 0, 1}), Rgb(1));
}

TEST(XmlEmitter, BlackOnesAreLeftOut) {
  const auto scene =
      load_text(scene_with("<emitter type='constant'><rgb name='radiance' value='0'/></emitter>"));
  EXPECT_TRUE(scene->lights.empty());
  EXPECT_EQ(scene->warnings.size(), 2u);  // the black one, and that nothing emits
}

}  // namespace
}  // namespace octolux::test
