// Student's distribution against published quantiles and closed forms.
#include "core/statistics.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace octolux {
namespace {

TEST(Statistics, StudentMatchesPublishedQuantiles) {
  // Abramowitz & Stegun, table 26.10: quantiles of A(t|dof) to three decimals; p changes by the
  // density, at most 0.4, times the rounding of 5e-4, and here by far less.
  EXPECT_NEAR(student_t_p(2.228, 10), 0.05, 2e-5);
  EXPECT_NEAR(student_t_p(4.587, 10), 0.001, 1e-6);
  EXPECT_NEAR(student_t_p(2.750, 30), 0.01, 2e-5);
  EXPECT_NEAR(student_t_p(1.980, 120), 0.05, 6e-5);
}

TEST(Statistics, StudentHasClosedFormsForOneAndTwoDegrees) {
  for (const double t : {0.0, 0.1, 1.0, 3.0, 50.0, 1e4}) {
    const double one = 1 - 2 * std::atan(t) / std::numbers::pi;  // Cauchy
    const double two = 1 - t / std::sqrt(2 + t * t);
    EXPECT_NEAR(student_t_p(t, 1), one, 1e-13) << t;
    EXPECT_NEAR(student_t_p(-t, 2), two, 1e-13) << t;
  }
  // Far out, where 1 - ... has no digits left: 1 - t / sqrt(2 + t^2) -> 1 / t^2.
  EXPECT_NEAR(student_t_p(1e8, 2) * 1e16, 1, 1e-9);
}

TEST(Statistics, StudentOfManyDegreesIsNormal) {
  for (const double t : {0.5, 2.0, 6.0}) {
    // p grows by (t^3 + t) pdf / (2 dof) (Abramowitz & Stegun 26.7.8); what follows is of the order
    // of t^8 / (32 dof^2), relative to p.
    const double dof = 1e5, pdf = std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi);
    const double p = z_test_p(t) + (t * t * t + t) * pdf / (2 * dof);
    EXPECT_NEAR(student_t_p(t, dof) / p, 1, (1 + std::pow(t, 8) / 32) / (dof * dof)) << t;
    EXPECT_DOUBLE_EQ(student_t_p(t, std::numeric_limits<double>::infinity()), z_test_p(t));
  }
}

TEST(Statistics, IncompleteBetaOfWholeNumbersIsABinomialSum) {
  // I_x(2, 3) = 6 x^2 (1-x)^2 + 4 x^3 (1-x) + x^4
  for (const double x : {0.0, 0.05, 0.3, 0.5, 0.77, 1.0}) {
    const double y = 1 - x, sum = 6 * x * x * y * y + 4 * x * x * x * y + x * x * x * x;
    EXPECT_NEAR(incomplete_beta(x, 2, 3), sum, 1e-14) << x;
  }
}

TEST(Statistics, WelchOfEqualVariancesAddsTheDegrees) {
  EXPECT_DOUBLE_EQ(welch_dof(2, 10, 2, 10), 18);
  EXPECT_DOUBLE_EQ(welch_dof(2, 10, 0, 5), 9);  // only one is uncertain
  const double exact = std::numeric_limits<double>::infinity();
  EXPECT_EQ(welch_dof(2, exact, 2, exact), exact);
}

}  // namespace
}  // namespace octolux
