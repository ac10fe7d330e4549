// What instancing does to areas, boxes and normals, against shapes that were moved.
#include "core/instance.h"

#include <gtest/gtest.h>

#include "core/constants.h"

namespace octolux {
namespace {

const Affine kMap = translation(3, -1, 2) * rotation(1, 2, 3, 40) * scaling(2, -0.5, 1.5);

Shape two_triangles() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  return {mesh, -1, -1, ""};
}

Shape sphere() { return {Quadric{Quadric::Kind::sphere, {}, {}}, -1, -1, ""}; }

TEST(Instance, AreaIsThatOfTheMovedShape) {
  for (const Shape& shape : {two_triangles(), sphere()}) {
    const double expected = area(moved(shape, kMap));
    EXPECT_NEAR(area(shape, kMap), expected, 1e-5 * expected);
  }
  EXPECT_NEAR(area(sphere(), scaling(3, 3, 3)), 36 * kPi, 1e-3 * 36 * kPi);
}

TEST(Instance, FrontStaysInFront) {
  ASSERT_LT(kMap.determinant(), 0);
  const Instance instance{0, kMap, *kMap.inverse()};
  for (const bool vertex_normals : {false, true}) {
    Shape shape = two_triangles();
    auto& mesh = std::get<TriangleMesh>(shape.geometry);
    if (vertex_normals) mesh.normals.assign(4, normalize(Vec3{0.1f, 0.2f, 1}));
    const Shape there = moved(shape, kMap);
    const auto& moved_mesh = std::get<TriangleMesh>(there.geometry);
    const SurfacePoint placed = place(surface_point(mesh, 0, 0.25f, 0.25f), instance);
    // The winding is turned round, so the barycentrics change places.
    const SurfacePoint expected = surface_point(moved_mesh, 0, 0.25f, 0.25f);
    EXPECT_LE(length(placed.position - expected.position), 4 * 0x1p-23f * 8);
    EXPECT_GT(dot(placed.ng, expected.ng), 0.99999f);
    EXPECT_GT(dot(placed.ns, expected.ns), 0.99999f);
    EXPECT_EQ(placed.ns == placed.ng, !vertex_normals);
  }
  const auto quadric = std::get<Quadric>(sphere().geometry);
  const SurfacePoint pole = place(surface_point(quadric, {0, 1, 0}), instance);
  EXPECT_GT(dot(pole.ng, pole.position - kMap.point({0, 0, 0})), 0);
}

TEST(Instance, ShadingNormalNeverBelowTheSurface) {
  const Affine flat = scaling(1, 1, 0.01);
  SurfacePoint point;
  point.ng = {0, 0, 1};
  point.ns = normalize(Vec3{1, 0, 0.1f});
  const SurfacePoint placed = place(point, {0, flat, *flat.inverse()});
  EXPECT_GT(dot(placed.ng, placed.ns), 0);
  EXPECT_FLOAT_EQ(length(placed.ns), 1);
}

TEST(Instance, BoxesHoldTheirImage) {
  const Bounds box = place(Bounds{{-1, -2, -3}, {1, 2, 3}}, rotation(0, 0, 1, 90));
  EXPECT_NEAR(box.lower.x, -2, 1e-6f);
  EXPECT_NEAR(box.upper.y, 1, 1e-6f);
  EXPECT_NEAR(box.upper.z, 3, 1e-6f);
  EXPECT_TRUE(place(Bounds{}, kMap).empty());
}

TEST(Instance, SkewIsOneUnlessSheared) {
  EXPECT_NEAR(skew(kMap), 1, 1e-12);
  Affine shear;
  shear.m[0][1] = 3;
  EXPECT_NEAR(skew(shear), std::sqrt(10.0), 1e-12);
}

}  // namespace
}  // namespace octolux
