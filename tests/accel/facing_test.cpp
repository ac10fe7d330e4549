// accel/facing.h: no surface that a look-up counts is passed over, and most others are.
#include "accel/facing.h"

#include <gtest/gtest.h>

#include <bit>

#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

Vec3 random_direction(Rng& rng) { return normalize(sample_sphere(rng.uniform2())); }

/// A direction at angle `cosine` to `axis`.
Vec3 tilted(Vec3 axis, float cosine, Rng& rng) {
  const Vec3 other = random_direction(rng);
  const Vec3 across = normalize(other - axis * dot(other, axis));
  return normalize(axis * cosine + across * std::sqrt(1 - cosine * cosine));
}

TEST(Facing, ASurfaceIsInOneClass) {
  Rng rng(1, Stream::test, 800, 0);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(std::popcount(facing(random_direction(rng))), 1);
}

TEST(Facing, NothingWithinTheCosineIsPassedOver) {
  Rng rng(1, Stream::test, 801, 0);
  for (int i = 0; i < 200'000; ++i) {
    const Vec3 query = random_direction(rng);
    const Vec3 surface = tilted(query, kFacingCosine, rng);  // as far off as may be
    ASSERT_NE(facing(surface) & facing_near(query), 0u) << i;
    ASSERT_NE(facing(query) & facing_near(query), 0u) << i;
  }
}

TEST(Facing, WhatFacesAwayIsPassedOver) {
  Rng rng(1, Stream::test, 802, 0);
  for (int i = 0; i < 10'000; ++i) {
    // Beyond a class's width (27.9 degrees) from the 73.7 degrees that are near.
    const Vec3 query = random_direction(rng);
    ASSERT_EQ(facing(tilted(query, -0.21f, rng)) & facing_near(query), 0u) << i;
  }
}

TEST(Facing, NothingAcrossIsPassedOver) {
  Rng rng(1, Stream::test, 803, 0);
  for (int i = 0; i < 200'000; ++i) {
    const Vec3 query = random_direction(rng);
    const float cosine = kFacingCosine * (2 * rng.uniform() - 1);
    ASSERT_NE(facing(tilted(query, cosine, rng)) & facing_across(query), 0u) << i;
    ASSERT_NE(facing(tilted(query, kFacingCosine, rng)) & facing_across(query), 0u) << i;
  }
}

TEST(Facing, AWallIsNotAcrossItselfNorItsBack) {
  const Vec3 walls[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Vec3& a : walls) {
    for (const Vec3& b : walls) {
      EXPECT_EQ((facing(a) & facing_across(b)) != 0, dot(a, b) == 0);
    }
  }
}

TEST(Facing, WallsAreApart) {
  const Vec3 walls[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Vec3& a : walls) {
    for (const Vec3& b : walls) EXPECT_EQ((facing(a) & facing_near(b)) != 0, a == b);
  }
}

TEST(Facing, NotANumberFacesNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(facing_near({nan, nan, nan}), 0u);
  EXPECT_EQ(facing_across({nan, nan, nan}), 0u);
}

}  // namespace
}  // namespace octolux
