// Statistics that decide: tests of normal and Student deviates, Sidak's correction, running mean
// and variance. Limits follow from the variance of what is measured and a stated probability of a
// false alarm, never from tuning. Pure functions of their arguments; thread-safe.
#pragma once

#include <cmath>
#include <cstddef>

namespace octolux {

/// Significance of each of `tests` comparisons so that together they have `alpha`: exact for
/// independent ones, on the safe side for two-sided tests of dependent normal ones (Sidak 1967).
inline double sidak(double alpha, double tests) { return -std::expm1(std::log1p(-alpha) / tests); }

/// Two-sided p-value of a standard normal deviate.
inline double z_test_p(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// Two-sided p-value of a deviate of Student's distribution with `dof` > 0 degrees of freedom;
/// infinite: the normal one.
double student_t_p(double t, double dof);

/// Degrees of freedom of the sum of two estimated variances of means, each from `n_` independent
/// samples (Welch 1947, Satterthwaite 1946). Infinite n: that variance is known.
double welch_dof(double variance_a, double n_a, double variance_b, double n_b);

/// The regularised incomplete beta function I_x(a, b), 0 <= x <= 1, a and b > 0 (DLMF 8.17).
double incomplete_beta(double x, double a, double b);

/// Mean and its variance, in one pass (Welford 1962).
class Running {
 public:
  void add(double x) {
    ++n_;
    const double d = x - mean_;
    mean_ += d / static_cast<double>(n_);
    m2_ += d * (x - mean_);
  }
  std::size_t count() const { return n_; }
  double mean() const { return mean_; }
  double variance() const { return n_ > 1 ? m2_ / static_cast<double>(n_ - 1) : 0; }
  double variance_of_mean() const { return n_ > 0 ? variance() / static_cast<double>(n_) : 0; }
  double standard_error() const { return std::sqrt(variance_of_mean()); }
  /// Deviate of the mean from `expected`.
  double z(double expected) const { return (mean() - expected) / standard_error(); }

 private:
  std::size_t n_ = 0;
  double mean_ = 0, m2_ = 0;
};

}  // namespace octolux
