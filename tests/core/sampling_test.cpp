// Warps against their densities: each is mapped back to coordinates in which it must be uniform on
// the unit square, and a chi-square test looks at a grid there.
#include "core/sampling.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

constexpr int kDraws = 200000, kGrid = 16;

/// p-value that `map(u)`, a point of the unit square, is uniform.
template <typename Map>
double uniform_p(int test, const Map& map) {
  std::vector<double> counts(kGrid * kGrid, 0.0);
  Rng rng(1, Stream::test, 20, test);
  for (int i = 0; i < kDraws; ++i) {
    const Vec2 v = map(rng.uniform2());
    const int x = std::clamp(static_cast<int>(v.x * kGrid), 0, kGrid - 1);
    const int y = std::clamp(static_cast<int>(v.y * kGrid), 0, kGrid - 1);
    ++counts[y * kGrid + x];
  }
  return chi2_test_p(counts, std::vector<double>(counts.size(), double(kDraws) / counts.size()));
}

float turn(float y, float x) { return std::atan2(y, x) / (2 * kPi) + 0.5f; }

TEST(Sampling, DiskIsUniform) {
  EXPECT_GT(uniform_p(0,
                      [](Vec2 u) {
                        const Vec2 d = sample_disk(u);
                        return Vec2{d.x * d.x + d.y * d.y, turn(d.y, d.x)};
                      }),
            kAlpha);
}

TEST(Sampling, SquareOfADiskIsWhereItCameFrom) {
  const float steps[] = {0, 0x1p-24f, 0.1f, 0.25f, 0.5f, 0.6f, 0.99f, kOneMinusEpsilon};
  for (const float x : steps) {
    for (const float y : steps) {
      const Vec2 u = square_of_disk(sample_disk({x, y}));
      EXPECT_NEAR(u.x, x, 4 * 0x1p-23f) << x << " " << y;
      EXPECT_NEAR(u.y, y, 4 * 0x1p-23f) << x << " " << y;
      EXPECT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1) << x << " " << y;
    }
  }
  const Vec2 beyond = square_of_disk({1.01f, -0.3f});  // directions are unit but for rounding
  EXPECT_TRUE(beyond.x < 1 && beyond.y >= 0);
}

TEST(Sampling, CosineHemisphereFollowsItsPdf) {
  // pdf_w = cos / pi makes cos^2 uniform: P(cos < c) = integral of 2 c dc.
  EXPECT_GT(uniform_p(1,
                      [](Vec2 u) {
                        const Vec3 w = sample_cosine_hemisphere(u);
                        return Vec2{w.z * w.z, turn(w.y, w.x)};
                      }),
            kAlpha);
  EXPECT_EQ(cosine_hemisphere_pdf_w({0, 0, 1}), kInvPi);
  EXPECT_EQ(cosine_hemisphere_pdf_w({0, 0, -1}), 0);
}

TEST(Sampling, SphereIsUniform) {
  EXPECT_GT(uniform_p(2,
                      [](Vec2 u) {
                        const Vec3 w = sample_sphere(u);
                        return Vec2{(w.z + 1) / 2, turn(w.y, w.x)};
                      }),
            kAlpha);
}

TEST(Sampling, TriangleIsUniform) {
  // Uniform on u, v >= 0, u + v <= 1: (1 - u)^2 and v / (1 - u) are uniform and independent.
  EXPECT_GT(uniform_p(3,
                      [](Vec2 u) {
                        const Vec2 b = sample_triangle(u);
                        return Vec2{(1 - b.x) * (1 - b.x), b.x < 1 ? b.y / (1 - b.x) : 0};
                      }),
            kAlpha);
}

TEST(Sampling, LinearFollowsItsDensity) {
  const double alpha = sidak(kAlpha, 4);
  int test = 4;
  for (const Vec2 ends : {Vec2{1, 1}, Vec2{0, 2}, Vec2{3, 0}, Vec2{0.5f, 4}}) {
    EXPECT_GT(uniform_p(test++,
                        [&](Vec2 u) {
                          const float x = sample_linear(u.x, ends.x, ends.y);
                          const float cdf =
                              (ends.x * x + (ends.y - ends.x) * x * x / 2) * 2 / (ends.x + ends.y);
                          return Vec2{cdf, u.y};
                        }),
              alpha);
    EXPECT_EQ(sample_linear(0, ends.x, ends.y), 0);
    EXPECT_NEAR(sample_linear(1, ends.x, ends.y), 1, 4 * 0x1p-24f);
  }
  EXPECT_EQ(sample_linear(0.25f, 0, 0), 0.25f);
}

TEST(Sampling, AWrongWarpFails) {
  EXPECT_LT(uniform_p(9, [](Vec2 u) { return Vec2{std::pow(u.x, 1.05f), u.y}; }), 1e-6);
}

TEST(Sampling, ResultsStayInTheirDomain) {
  for (const float x : {0.0f, 0x1p-24f, 0.5f, kOneMinusEpsilon}) {
    for (const float y : {0.0f, 0x1p-24f, 0.5f, kOneMinusEpsilon}) {
      const Vec2 d = sample_disk({x, y});
      EXPECT_LE(d.x * d.x + d.y * d.y, 1 + 4 * 0x1p-24f);
      const Vec3 w = sample_cosine_hemisphere({x, y});
      EXPECT_GT(w.z, 0);
      EXPECT_NEAR(length(w), 1, 4 * 0x1p-24f);
      EXPECT_NEAR(length(sample_sphere({x, y})), 1, 4 * 0x1p-24f);
      const Vec2 b = sample_triangle({x, y});
      EXPECT_GE(b.x, 0);
      EXPECT_GE(b.y, 0);
      EXPECT_LE(b.x + b.y, 1 + 0x1p-23f);
    }
  }
}

TEST(Sampling, PowerHeuristicSharesOutOne) {
  const auto [a, b] = Vec2{0.3f, 1.7f};
  EXPECT_NEAR(power_heuristic(2, a, 1, b) + power_heuristic(1, b, 2, a), 1, 2 * 0x1p-24f);
  EXPECT_FLOAT_EQ(power_heuristic(1, 2, 1, 1), 0.8f);
  EXPECT_EQ(power_heuristic(1, 0, 1, 0), 0);
  EXPECT_EQ(power_heuristic(1, 0, 1, 1), 0);
  EXPECT_EQ(power_heuristic(1, 1, 1, 0), 1);
  // Squares that over- or underflow.
  EXPECT_EQ(power_heuristic(1, kInfinity, 1, 1), 1);
  EXPECT_EQ(power_heuristic(1, 1, 1, kInfinity), 0);
  EXPECT_EQ(power_heuristic(1, 1e-30f, 1, 0), 1);
  EXPECT_FLOAT_EQ(power_heuristic(1, 1e-30f, 1, 1e-30f), 0.5f);
  EXPECT_FLOAT_EQ(power_heuristic(1, 1e30f, 1, 1e30f), 0.5f);
}

}  // namespace
}  // namespace octolux
