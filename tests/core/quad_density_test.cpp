// core/quad_density.h: samples follow the density, which is normalised and finds what is small.
#include "core/quad_density.h"

#include <gtest/gtest.h>

#include "core/constants.h"
#include "core/rng.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

constexpr std::size_t kFewest = 8;
constexpr int kGrid = 32;

struct Case {
  const char* name;
  std::vector<QuadDensity::Point> points;
};

/// Even ones, and a tenth of them in a spot of side 1/100.
std::vector<QuadDensity::Point> spotted(int n) {
  std::vector<QuadDensity::Point> points;
  for (int i = 0; i < n; ++i) {
    Rng rng(1, Stream::test, 7, static_cast<std::uint64_t>(i));
    Vec2 u = rng.uniform2();
    if (i % 10 == 0) u = {0.7f + 0.01f * u.x, 0.2f + 0.01f * u.y};
    points.push_back({u, 0.5f + rng.uniform()});
  }
  return points;
}

std::vector<Case> cases() {
  std::vector<QuadDensity::Point> low = spotted(500);
  for (auto& p : low) p.u.y *= 0.25f;  // nothing above
  return {{"nothing", {}},
          {"no mass", {{{0.3f, 0.4f}, 0}}},
          {"one", {{{0.3f, 0.4f}, 2}}},
          {"coinciding", std::vector<QuadDensity::Point>(50, {{0.3f, 0.4f}, 1})},
          {"corner", std::vector<QuadDensity::Point>(50, {{kOneMinusEpsilon, 0}, 1})},
          {"spot", spotted(2000)},
          {"low", low}};
}

std::size_t cell(Vec2 u) {
  return static_cast<std::size_t>(u.y * kGrid) * kGrid + static_cast<std::size_t>(u.x * kGrid);
}

TEST(QuadDensity, IsThatOfItsSamples) {
  constexpr int kSamples = 100'000, kFine = 32;  // steps along a cell's side: 1/1024, the finest
  const std::vector<Case> all = cases();
  for (Case c : all) {
    const QuadDensity density(c.points, kFewest);
    std::vector<double> observed(kGrid * kGrid), expected(kGrid * kGrid);
    for (int i = 0; i < kSamples; ++i) {
      Rng rng(2, Stream::test, 7, static_cast<std::uint64_t>(i));
      const Vec2 u = density.sample(rng.uniform2());
      ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1) << c.name;
      ++observed[cell(u)];
    }
    double integral = 0;
    constexpr int n = kGrid * kFine;
    for (int i = 0; i < n * n; ++i) {
      const Vec2 u{(static_cast<float>(i % n) + 0.5f) / n, (static_cast<float>(i / n) + 0.5f) / n};
      const double p = density(u);
      expected[cell(u)] += p / (n * n) * kSamples;
      integral += p / (n * n);
    }
    EXPECT_NEAR(integral, 1, 1e-5) << c.name;
    EXPECT_GT(chi2_test_p(observed, expected), sidak(kAlpha, static_cast<double>(all.size())))
        << c.name;
  }
}

TEST(QuadDensity, FindsASmallSpotAndIsUniformWithoutPoints) {
  std::vector<QuadDensity::Point> points = spotted(2000);
  const QuadDensity density(points, kFewest);
  // A tenth of the mass on 10^-4 of the square, blurred by squares of at most 8 points.
  EXPECT_GT(density({0.705f, 0.205f}), 300);
  EXPECT_LT(density({0.3f, 0.8f}), 5);
  EXPECT_EQ(QuadDensity()({0.3f, 0.8f}), 1);
  const Vec2 u = QuadDensity().sample({0.3f, 0.8f});
  EXPECT_EQ(u.x, 0.3f);
  EXPECT_EQ(u.y, 0.8f);
}

TEST(QuadDensity, SamplesOfTheEdgesStayWhereThereIsMass) {
  std::vector<QuadDensity::Point> points = cases()[6].points;
  const QuadDensity density(points, kFewest);
  for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, kOneMinusEpsilon}) {
    for (const float y : {0.0f, 0x1p-24f, 0.25f, 0.5f, kOneMinusEpsilon}) {
      const Vec2 u = density.sample({x, y});
      EXPECT_GT(density(u), 0) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace octolux::test
