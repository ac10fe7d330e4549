// filter.h by inversion, one dimension at a time. Box and tent have closed forms. The gaussian,
// exp(-x^2/2) - exp(-8) on |x| < 4 standard deviations, has none: its cumulative is tabulated and
// the density taken as linear between knots. With 512 knots the density is right to 1e-5 and x to a
// few units in the last place of a float, which is finer than the 24 bits of u resolve.
#include "core/filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/sampling.h"

namespace octolux {
namespace {

constexpr double kGaussianRadius = 4;  // [standard deviations]

/// The gaussian's half x >= 0 with standard deviation 1: a constant of mathematics, made once.
class GaussianTable {
 public:
  GaussianTable() {
    const double bias = std::exp(-kGaussianRadius * kGaussianRadius / 2);
    for (int i = 0; i <= kCells; ++i) {
      const double x = kGaussianRadius * i / kCells;
      density_[i] = static_cast<float>(std::max(0.0, std::exp(-x * x / 2) - bias));
      const double area = std::sqrt(std::numbers::pi / 2) * std::erf(x * std::numbers::sqrt2 / 2);
      cdf_[i] = area - bias * x;
    }
    for (double& c : cdf_) c /= cdf_.back();
  }

  /// |x| for `u` in [0, 1).
  float sample(float u) const {
    const auto above = std::upper_bound(cdf_.begin() + 1, cdf_.end() - 1, static_cast<double>(u));
    const auto cell = above - (cdf_.begin() + 1);
    const auto rest = static_cast<float>((u - cdf_[cell]) / (cdf_[cell + 1] - cdf_[cell]));
    const float t = sample_linear(rest, density_[cell], density_[cell + 1]);
    return (static_cast<float>(cell) + t) * static_cast<float>(kGaussianRadius / kCells);
  }

 private:
  static constexpr int kCells = 512;
  std::array<double, kCells + 1> cdf_;
  std::array<float, kCells + 1> density_;  // not normalised
};

/// Inverts a symmetric profile: `half` maps [0, 1) to |x|.
template <typename Half>
float symmetric(float u, const Half& half) {
  return u < 0.5f ? -half(1 - 2 * u) : half(2 * u - 1);
}

}  // namespace

Vec2 Filter::sample(Vec2 u) const {
  if (kind == Kind::box) return {(2 * u.x - 1) * radius, (2 * u.y - 1) * radius};
  if (kind == Kind::tent) {
    const auto half = [this](float v) { return radius * (1 - std::sqrt(1 - v)); };
    return {symmetric(u.x, half), symmetric(u.y, half)};
  }
  static const GaussianTable table;
  const auto half = [this](float v) { return stddev * table.sample(v); };
  return {symmetric(u.x, half), symmetric(u.y, half)};
}

}  // namespace octolux
