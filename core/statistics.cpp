// statistics.h: Student's distribution through the incomplete beta function.
#include "core/statistics.h"

#include <limits>

namespace octolux {
namespace {

constexpr int kMaxTerms = 10000;
constexpr double kPrecision = 1e-15;

/// Terms of the continued fraction DLMF 8.17.22: d_{2m}, d_{2m+1}.
double fraction_term(int k, double x, double a, double b) {
  const double m = k / 2;
  if (k % 2 == 0) return m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
  return -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
}

/// 1 / (1 + d_1 / (1 + d_2 / (1 + ...))) by Lentz's method.
double beta_fraction(double x, double a, double b) {
  const double tiny = std::numeric_limits<double>::min();
  double f = 1, c = 1, d = 0;
  for (int k = 1; k < kMaxTerms; ++k) {
    const double term = fraction_term(k, x, a, b);
    d = 1 + term * d;
    c = 1 + term / c;
    d = 1 / (d == 0 ? tiny : d);
    c = c == 0 ? tiny : c;
    f *= c * d;
    if (std::abs(c * d - 1) < kPrecision) break;
  }
  return 1 / f;
}

}  // namespace

double incomplete_beta(double x, double a, double b) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double front = std::exp(a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) -
                                std::lgamma(a) - std::lgamma(b));
  // The fraction converges fast below the distribution's mean.
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(x, a, b) / a;
  return 1 - front * beta_fraction(1 - x, b, a) / b;
}

double student_t_p(double t, double dof) {
  constexpr double kMany = 1e8;  // beyond, the fraction's rounding is worse than the normal's bias
  if (!(dof < kMany)) return z_test_p(t);
  if (std::isinf(t)) return 0;
  return incomplete_beta(dof / (dof + t * t), dof / 2, 0.5);
}

double welch_dof(double variance_a, double n_a, double variance_b, double n_b) {
  const double sum = variance_a + variance_b;
  const double spread = variance_a * variance_a / (n_a - 1) + variance_b * variance_b / (n_b - 1);
  return spread > 0 ? sum * sum / spread : std::numeric_limits<double>::infinity();
}

}  // namespace octolux
