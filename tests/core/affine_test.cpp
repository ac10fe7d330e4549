// Transforms against values worked out by hand. Tolerances: coordinates of size s carry at most a
// few roundings to float.
#include "core/affine.h"

#include <gtest/gtest.h>

#include <cmath>

namespace octolux {
namespace {

void expect_near(Vec3 a, Vec3 b, float size) {
  const float tolerance = 4 * 0x1p-24f * size;
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Affine, PointsMoveAndVectorsDoNot) {
  const Affine t = translation(1, 2, 3);
  EXPECT_EQ(t.point({10, 20, 30}), (Vec3{11, 22, 33}));
  EXPECT_EQ(t.vector({10, 20, 30}), (Vec3{10, 20, 30}));
}

TEST(Affine, RotatesAnticlockwiseAboutTheAxis) {
  expect_near(rotation(0, 0, 5, 90).point({1, 0, 0}), {0, 1, 0}, 1);
  expect_near(rotation(1, 0, 0, 90).point({0, 1, 0}), {0, 0, 1}, 1);
  expect_near(rotation(0, 1, 0, 90).point({0, 0, 1}), {1, 0, 0}, 1);
  // A third of a turn about the space diagonal permutes the axes.
  expect_near(rotation(1, 1, 1, 120).point({1, 2, 3}), {3, 1, 2}, 3);
}

TEST(Affine, ProductAppliesTheRightOneFirst) {
  const Affine both = translation(1, 0, 0) * scaling(2, 2, 2);
  EXPECT_EQ(both.point({1, 1, 1}), (Vec3{3, 2, 2}));
  const Affine other = scaling(2, 2, 2) * translation(1, 0, 0);
  EXPECT_EQ(other.point({1, 1, 1}), (Vec3{4, 2, 2}));
}

TEST(Affine, InverseUndoes) {
  const Affine a = translation(3, -1, 2) * rotation(1, 2, 3, 40) * scaling(2, -0.5, 1e-3);
  const auto inverse = a.inverse();
  ASSERT_TRUE(inverse);
  const Vec3 p{0.3f, -7, 2};
  // Through float coordinates once, so the error is that of `a p` divided by the smallest scale.
  const Vec3 back = (*inverse * a).point(p);
  expect_near(back, p, 7);
}

TEST(Affine, DeterminantShowsMirroring) {
  EXPECT_DOUBLE_EQ(scaling(2, 3, 4).determinant(), 24);
  EXPECT_LT(scaling(-1, 1, 1).determinant(), 0);
  EXPECT_NEAR(rotation(3, 1, 2, 77).determinant(), 1, 1e-15);
}

TEST(Affine, SingularMapsHaveNoInverse) {
  EXPECT_FALSE(scaling(1, 0, 1).inverse());
  EXPECT_FALSE(scaling(0, 0, 0).inverse());
  EXPECT_FALSE((rotation(1, 2, 3, 30) * scaling(1, 1, 0) * rotation(3, 1, 2, 50)).inverse());
  EXPECT_FALSE(scaling(std::nan(""), 1, 1).inverse());
  EXPECT_FALSE(scaling(INFINITY, 1, 1).inverse());
  Affine parallel;  // two equal columns
  parallel.m = {{{1, 1, 0, 0}, {0.1, 0.1, 1, 0}, {0.3, 0.3, 0, 0}}};
  EXPECT_FALSE(parallel.inverse());
}

TEST(Affine, TinyAndFlatMapsAreNotSingular) {
  EXPECT_TRUE(scaling(1e-20, 1e-20, 1e-20).inverse());
  EXPECT_TRUE(scaling(1e3, 1e3, 1e-9).inverse());
}

TEST(Affine, NormalsStayPerpendicular) {
  const Affine a = rotation(1, 2, 3, 40) * scaling(1, 5, 0.2);
  const Vec3 tangent{1, 1, 0}, normal{1, -1, 3};
  const Vec3 n = Affine::normal(*a.inverse(), normal), t = a.vector(tangent);
  EXPECT_NEAR(dot(n, t), 0, 4 * 0x1p-24f * length(n) * length(t));
}

TEST(LookAt, BuildsMitsubasFrame) {
  const auto camera = look_at({0, 0, -5}, {0, 0, 0}, {0, 1, 0});
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->point({0, 0, 0}), (Vec3{0, 0, -5}));
  EXPECT_EQ(camera->vector({0, 0, 1}), (Vec3{0, 0, 1}));  // towards the target
  EXPECT_EQ(camera->vector({0, 1, 0}), (Vec3{0, 1, 0}));
  EXPECT_EQ(camera->vector({1, 0, 0}), (Vec3{1, 0, 0}));  // left: right-handed with y and z
  // Turned: looking along -x with z up, left is -y.
  const auto turned = look_at({4, 0, 0}, {0, 0, 0}, {0, 0, 1});
  ASSERT_TRUE(turned);
  expect_near(turned->vector({0, 0, 1}), {-1, 0, 0}, 1);
  expect_near(turned->vector({1, 0, 0}), {0, -1, 0}, 1);
}

TEST(LookAt, RefusesDegenerateViews) {
  EXPECT_FALSE(look_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0}));
  EXPECT_FALSE(look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0}));
  EXPECT_FALSE(look_at({0, 0, 0}, {0, 3, 0}, {0, 0, 0}));
}

}  // namespace
}  // namespace octolux
