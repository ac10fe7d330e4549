// Discrete distributions: counts against weights, the left-over u, and weights of zero.
#include "core/distribution.h"

#include <gtest/gtest.h>

#include "core/constants.h"
#include "core/rng.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

TEST(Distribution1D, IndexFollowsWeightsAndUIsUniformWithin) {
  const std::vector<double> weights{3, 0, 1e-3, 7, 0.5, 0, 2};
  const Distribution1D d(weights);
  constexpr int kDraws = 200000, kBins = 20;
  std::vector<double> counts(weights.size() * kBins, 0.0), expected;
  Rng rng(1, Stream::test, 40, 0);
  for (int i = 0; i < kDraws; ++i) {
    const Distribution1D::Sample s = d.sample(rng.uniform());
    ASSERT_EQ(s.pmf, d.pmf(s.index));
    ASSERT_GE(s.u, 0);
    ASSERT_LT(s.u, 1);
    ++counts[s.index * kBins + static_cast<int>(s.u * kBins)];
  }
  for (const double w : weights) {
    expected.insert(expected.end(), kBins, kDraws * w / d.total() / kBins);
  }
  EXPECT_GT(chi2_test_p(counts, expected), kAlpha);
  EXPECT_DOUBLE_EQ(d.total(), 12.501);
}

TEST(Distribution1D, ZeroWeightsAreNeverChosen) {
  const Distribution1D d(std::vector<double>{0, 0, 0.1, 0, 0.2, 0.3, 0, 0});
  for (const float u : {0.0f, 0x1p-24f, 0.1666f, 1 / 6.0f, 0.5f, kOneMinusEpsilon}) {
    EXPECT_GT(d.sample(u).pmf, 0) << u;
  }
  EXPECT_EQ(d.sample(0).index, 2);
  EXPECT_EQ(d.sample(kOneMinusEpsilon).index, 5);
  EXPECT_EQ(d.pmf(0), 0);
  EXPECT_EQ(d.pmf(7), 0);
}

TEST(Distribution1D, NothingToChoose) {
  for (const Distribution1D& d : {Distribution1D(), Distribution1D(std::vector<double>{}),
                                  Distribution1D(std::vector<double>{0, 0})}) {
    EXPECT_EQ(d.sample(0.3f).pmf, 0);
    EXPECT_EQ(d.total(), 0);
  }
  EXPECT_EQ(Distribution1D(std::vector<double>{0, 0}).pmf(1), 0);
}

TEST(Distribution1D, ManySmallWeightsKeepTheirShare) {
  // One heavy weight before a million light ones that are half of the sum.
  std::vector<double> weights(1000001, 1e-6);
  weights[0] = 1;
  const Distribution1D d(weights);
  std::vector<double> counts(101, 0.0), expected(101, 1000.0);
  expected[0] = 100000;
  Rng rng(1, Stream::test, 41, 0);
  for (int i = 0; i < 200000; ++i) {
    const int index = d.sample(rng.uniform()).index;
    ++counts[index == 0 ? 0 : 1 + (index - 1) / 10000];
  }
  EXPECT_GT(chi2_test_p(counts, expected), kAlpha);
}

TEST(Distribution2D, CellFollowsWeights) {
  constexpr int kWidth = 5, kHeight = 4, kDraws = 200000;
  std::vector<double> weights, counts(kWidth * kHeight * 4, 0.0), expected;
  for (int i = 0; i < kWidth * kHeight; ++i) weights.push_back(i / kWidth == 2 ? 0 : (i * 7) % 11);
  const Distribution2D d(weights, kWidth, kHeight);
  Rng rng(1, Stream::test, 42, 0);
  for (int i = 0; i < kDraws; ++i) {
    const Distribution2D::Sample s = d.sample(rng.uniform2());
    ASSERT_FLOAT_EQ(s.pmf, d.pmf(s.x, s.y));
    const int quarter = int(s.u.x * 2) + 2 * int(s.u.y * 2);
    ++counts[(s.y * kWidth + s.x) * 4 + quarter];
  }
  double sum = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    expected.insert(expected.end(), 4, kDraws * weights[i] / d.total() / 4);
    sum += d.pmf(i % kWidth, i / kWidth);
  }
  EXPECT_GT(chi2_test_p(counts, expected), kAlpha);
  EXPECT_NEAR(sum, 1, 20 * 0x1p-24);
  EXPECT_EQ(d.pmf(1, 2), 0);
}

TEST(Distribution2D, AllZero) {
  const Distribution2D d(std::vector<double>(6, 0.0), 3, 2);
  EXPECT_EQ(d.sample({0.5f, 0.5f}).pmf, 0);
  EXPECT_EQ(d.pmf(2, 1), 0);
}

}  // namespace
}  // namespace octolux
