// The judges judged: right distributions pass as often as promised (size), wrong ones fail (power).
#include "tests/stats.h"

#include <gtest/gtest.h>

#include "core/rng.h"

namespace octolux {
namespace {

using namespace test;

/// Counts of `n` draws into cells of probabilities `p`.
std::vector<double> multinomial(Rng& rng, const std::vector<double>& p, int n) {
  std::vector<double> counts(p.size(), 0.0);
  for (int i = 0; i < n; ++i) {
    double u = rng.uniform();
    std::size_t cell = 0;
    while (cell + 1 < p.size() && u >= p[cell]) u -= p[cell++];
    ++counts[cell];
  }
  return counts;
}

std::vector<double> times(std::vector<double> v, double s) {
  for (double& x : v) x *= s;
  return v;
}

TEST(Stats, ChiSquareMatchesPublishedQuantiles) {
  // Abramowitz & Stegun, table 26.8: quantiles to six digits, so p to about 1e-5 of itself.
  EXPECT_NEAR(chi2_p(3.84146, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi2_p(18.3070, 10), 0.05, 1e-6);
  EXPECT_NEAR(chi2_p(29.5883, 10), 0.001, 1e-7);
  EXPECT_NEAR(chi2_p(124.342, 100), 0.05, 1e-6);
  EXPECT_NEAR(chi2_p(3.94030, 10), 0.95, 1e-6);
  EXPECT_EQ(chi2_p(0, 5), 1);
  // Two degrees of freedom have a closed form, into the far tail.
  for (const double x : {0.1, 1.0, 5.0, 50.0, 300.0}) {
    EXPECT_NEAR(chi2_p(x, 2) / std::exp(-x / 2), 1, 1e-9) << x;
  }
}

TEST(Stats, NormalDeviateMatchesPublishedQuantiles) {
  EXPECT_NEAR(z_test_p(1.959964), 0.05, 1e-7);
  EXPECT_NEAR(z_test_p(-3.290527), 0.001, 1e-8);
  EXPECT_EQ(z_test_p(0), 1);
}

TEST(Stats, SidakGivesTheStatedTotal) {
  for (const double tests : {1.0, 7.0, 1e6}) {
    const double each = sidak(0.01, tests);
    EXPECT_NEAR(-std::expm1(tests * std::log1p(-each)), 0.01, 1e-12);
  }
}

TEST(Stats, RunningIsMeanAndSampleVariance) {
  Running r;
  EXPECT_EQ(r.variance_of_mean(), 0);
  const double offset = 1e9;  // a sum of squares would lose everything
  for (const double x : {1.0, 2.0, 3.0, 4.0}) r.add(offset + x);
  EXPECT_EQ(r.count(), 4u);
  EXPECT_DOUBLE_EQ(r.mean(), offset + 2.5);
  EXPECT_NEAR(r.variance(), 5.0 / 3, 1e-6);
  EXPECT_NEAR(r.standard_error(), std::sqrt(5.0 / 12), 1e-6);
  EXPECT_NEAR(r.z(offset + 2.5 - r.standard_error()), 1, 1e-6);
}

TEST(Stats, PValuesOfTheRightDistributionAreUniform) {
  const std::vector<double> p{0.1, 0.2, 0.3, 0.25, 0.05, 0.1};
  constexpr int kTrials = 3000, kDraws = 1000, kBins = 10;
  std::vector<double> chi2_bins(kBins, 0.0), z_bins(kBins, 0.0);
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng(1, Stream::test, 10, trial);
    const double chi2 = chi2_test_p(multinomial(rng, p, kDraws), times(p, kDraws));
    ++chi2_bins[std::min(kBins - 1, static_cast<int>(chi2 * kBins))];
    Running mean;
    for (int i = 0; i < kDraws; ++i) mean.add(rng.uniform());
    ++z_bins[std::min(kBins - 1, static_cast<int>(z_test_p(mean.z(0.5)) * kBins))];
  }
  const std::vector<double> expected(kBins, double(kTrials) / kBins);
  EXPECT_GT(chi2_test_p(chi2_bins, expected), kAlpha);
  EXPECT_GT(chi2_test_p(z_bins, expected), kAlpha);
}

TEST(Stats, AWrongPdfFails) {
  const std::vector<double> truth{0.1, 0.2, 0.3, 0.4};
  const std::vector<double> wrong{0.11, 0.2, 0.3, 0.39};
  Rng rng(1, Stream::test, 11, 0);
  const std::vector<double> counts = multinomial(rng, truth, 100000);
  EXPECT_GT(chi2_test_p(counts, times(truth, 100000)), kAlpha);
  EXPECT_LT(chi2_test_p(counts, times(wrong, 100000)), 1e-9);
}

TEST(Stats, SamplesWhereThereShouldBeNoneFail) {
  EXPECT_EQ(chi2_test_p({500, 500, 100}, {550, 550, 0}), 0);
  EXPECT_GT(chi2_test_p({500, 500, 1}, {500, 500, 1}), 0.5);  // a small cell is pooled, not judged
}

}  // namespace
}  // namespace octolux
