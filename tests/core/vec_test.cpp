// Vectors and frames: identities to a few units in the last place.
#include "core/vec.h"

#include <gtest/gtest.h>

#include "core/frame.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

TEST(Vec3, ProductsAndLengths) {
  const Vec3 a{1, 2, 3}, b{-4, 5, 6};
  EXPECT_EQ(dot(a, b), 24);
  EXPECT_EQ(cross(a, b), (Vec3{-3, -18, 13}));
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(length(Vec3{2, 3, 6}), 7);
  EXPECT_EQ(length2(Vec3{2, 3, 6}), 49);
  EXPECT_EQ(abs(b), (Vec3{4, 5, 6}));
  EXPECT_EQ(min(a, b), (Vec3{-4, 2, 3}));
  EXPECT_EQ(max(a, b), (Vec3{1, 5, 6}));
  EXPECT_EQ(max_component(a), 3);
  EXPECT_EQ(a[0] + 10 * a[1] + 100 * a[2], 321);
  EXPECT_FALSE(is_finite(Vec3{1, INFINITY, 1}));
}

void expect_orthonormal(const Frame& f, Vec3 n) {
  // Entries are sums of two or three rounded products of numbers up to 1.
  constexpr float tolerance = 8 * 0x1p-24f;
  EXPECT_EQ(f.n, n);
  EXPECT_NEAR(length(f.s), 1, tolerance);
  EXPECT_NEAR(length(f.t), 1, tolerance);
  EXPECT_NEAR(dot(f.s, f.t), 0, tolerance);
  EXPECT_NEAR(dot(f.s, n), 0, tolerance);
  EXPECT_NEAR(dot(f.t, n), 0, tolerance);
  EXPECT_NEAR(dot(cross(f.s, f.t), n), 1, tolerance);
}

TEST(Frame, IsRightHandedAndOrthonormalEverywhere) {
  Rng rng(1, Stream::test, 30, 0);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 n = sample_sphere(rng.uniform2());
    expect_orthonormal(Frame::from_normal(n), n);
  }
  for (const Vec3 n :
       {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{1, 0, -0.0f},
        normalize({1e-4f, -1e-4f, -1}), normalize({1e-20f, 0, -1})}) {
    expect_orthonormal(Frame::from_normal(n), n);
  }
}

TEST(Frame, LocalAndWorldAreInverse) {
  Rng rng(1, Stream::test, 31, 0);
  for (int i = 0; i < 1000; ++i) {
    const Frame f = Frame::from_normal(sample_sphere(rng.uniform2()));
    const Vec3 v = sample_sphere(rng.uniform2());
    EXPECT_NEAR(length(f.to_world(f.to_local(v)) - v), 0, 16 * 0x1p-24f);
    EXPECT_NEAR(length(f.to_local(f.to_world(v)) - v), 0, 16 * 0x1p-24f);
  }
}

}  // namespace
}  // namespace octolux
