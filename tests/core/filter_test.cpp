// Pixel filters: offsets against the profiles of Mitsuba's box, tent and gaussian.
#include "core/filter.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/constants.h"
#include "core/rng.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

constexpr double kBias = 3.3546262790251185e-4;  // exp(-8): the gaussian at 4 standard deviations

struct Case {
  Filter filter;
  double radius;
  std::function<double(double)> profile;
};

std::vector<Case> cases() {
  const auto gaussian = [](double s) {
    return [s](double x) { return std::max(0.0, std::exp(-x * x / (2 * s * s)) - kBias); };
  };
  return {{{Filter::Kind::box, 0.5f, 0}, 0.5, [](double) { return 1.0; }},
          {{Filter::Kind::tent, 1, 0}, 1, [](double x) { return 1 - std::abs(x); }},
          {{Filter::Kind::tent, 2.5f, 0}, 2.5, [](double x) { return 2.5 - std::abs(x); }},
          {{Filter::Kind::gaussian, 2, 0.5f}, 2, gaussian(0.5)},
          {{Filter::Kind::gaussian, 1.2f, 0.3f}, 1.2, gaussian(0.3)}};
}

/// Integral of the profile over [a, b], Simpson's rule.
double integral(const Case& c, double a, double b) {
  constexpr int kSteps = 64;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const int weight = i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2;
    sum += weight * c.profile(a + (b - a) * i / kSteps);
  }
  return sum * (b - a) / kSteps / 3;
}

TEST(Filter, OffsetsFollowTheProfile) {
  constexpr int kDraws = 400000, kGrid = 20;
  int test = 0;
  for (const Case& c : cases()) {
    std::vector<double> counts(kGrid * kGrid, 0.0), expected, share;
    Rng rng(1, Stream::test, 50, test++);
    const auto bin = [&](float x) { return int((x / c.radius + 1) / 2 * kGrid); };
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 d = c.filter.sample(rng.uniform2());
      ASSERT_TRUE(std::abs(d.x) <= c.radius && std::abs(d.y) <= c.radius);
      ++counts[std::min(bin(d.y), kGrid - 1) * kGrid + std::min(bin(d.x), kGrid - 1)];
    }
    const double total = integral(c, -c.radius, 0) + integral(c, 0, c.radius);
    for (int i = 0; i < kGrid; ++i) {
      const double a = c.radius * (2.0 * i / kGrid - 1);
      share.push_back(integral(c, a, a + 2 * c.radius / kGrid) / total);
    }
    for (int i = 0; i < kGrid * kGrid; ++i) {
      expected.push_back(kDraws * share[i / kGrid] * share[i % kGrid]);
    }
    EXPECT_GT(chi2_test_p(counts, expected), sidak(kAlpha, 5)) << test;
  }
}

TEST(Filter, GaussianInvertsItsCumulativeToFloatPrecision) {
  const auto cdf = [](double x) {
    return std::sqrt(std::acos(-1.0) / 2) * std::erf(x / std::sqrt(2.0)) - kBias * x;
  };
  const Filter filter{Filter::Kind::gaussian, 4, 1};
  Rng rng(1, Stream::test, 51, 0);
  for (int i = 0; i < 100000; ++i) {
    const float u = rng.uniform();
    const double x = filter.sample({u, 0.5f}).x;
    const double u_back = (1 + std::copysign(cdf(std::abs(x)) / cdf(4), x)) / 2;
    // x is a float below 4, so it is known to 2^-22; density times that, and one step of u.
    const double density = (std::exp(-x * x / 2) - kBias) / (2 * cdf(4));
    EXPECT_NEAR(u_back, u, density * 0x1p-21 + 0x1p-24) << x;
  }
}

TEST(Filter, EndsAndMiddle) {
  for (const Case& c : cases()) {
    EXPECT_EQ(c.filter.sample({0.5f, 0.5f}).x, 0);
    EXPECT_NEAR(c.filter.sample({0, 0.5f}).x, -c.radius, c.radius * 0x1p-22);
    const float last = c.filter.sample({0.5f, kOneMinusEpsilon}).y;
    EXPECT_GT(last, 0.9 * c.radius);
    EXPECT_LE(last, c.radius);
  }
}

TEST(Filter, IsMonotonousInU) {
  for (const Case& c : cases()) {
    float before = -kInfinity;
    for (int i = 0; i < 4096; ++i) {
      const float x = c.filter.sample({static_cast<float>(i) / 4096, 0.5f}).x;
      EXPECT_GT(x, before);
      before = x;
    }
  }
}

}  // namespace
}  // namespace octolux
