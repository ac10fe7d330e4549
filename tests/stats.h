// Statistics that decide tests: those of core/statistics.h, and chi-square. Tolerances follow from
// the variance of what is measured and a stated probability of a false alarm, never from tuning.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/statistics.h"

namespace octolux::test {

/// Probability that any single test of this suite fails although the code is right.
inline constexpr double kAlpha = 1e-4;

using octolux::Running;
using octolux::sidak;
using octolux::z_test_p;

/// P(X > x) for chi-square with `dof` degrees of freedom: the regularised upper incomplete gamma
/// function Q(dof/2, x/2), by series or continued fraction (Numerical Recipes 6.2).
inline double chi2_p(double x, double dof) {
  const double a = dof / 2, y = x / 2;
  if (y <= 0) return 1;
  const double front = std::exp(-y + a * std::log(y) - std::lgamma(a));
  if (y < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-15; ++n) sum += term *= y / n;
    return 1 - front * sum;
  }
  double b = y + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return front * h;
}

/// p-value of observed counts against expected ones; cells expecting fewer than 5 are pooled.
inline double chi2_test_p(const std::vector<double>& observed,
                          const std::vector<double>& expected) {
  double chi2 = 0, pooled_o = 0, pooled_e = 0;
  int cells = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] < 5) {
      pooled_o += observed[i];
      pooled_e += expected[i];
      continue;
    }
    chi2 += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
    ++cells;
  }
  if (pooled_e >= 5) {
    chi2 += (pooled_o - pooled_e) * (pooled_o - pooled_e) / pooled_e;
    ++cells;
  } else if (pooled_o > 5 * (pooled_e + 5)) {
    return 0;  // many samples where there should be hardly any
  }
  return cells < 2 ? 1 : chi2_p(chi2, cells - 1);
}

}  // namespace octolux::test
