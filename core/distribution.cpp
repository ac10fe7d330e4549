// distribution.h: inversion by indexed search over the cumulative sum.
#include "core/distribution.h"

#include <algorithm>
#include <cstddef>

#include "core/check.h"
#include "core/constants.h"

namespace octolux {

Distribution1D::Distribution1D(std::span<const double> weights) : cdf_(weights.size() + 1) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    OCTOLUX_CHECK(weights[i] >= 0 && std::isfinite(weights[i]));
    cdf_[i + 1] = cdf_[i] + weights[i];
  }
  total_ = cdf_.back();
  if (total_ == 0) return;
  // Division, not multiplication by 1 / total: all sums equal to the total become exactly 1, so a
  // tail of zero weights is out of reach of any u < 1.
  for (double& c : cdf_) c /= total_;
  start_.reserve(weights.size());
  std::uint32_t i = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double u = static_cast<double>(k) / static_cast<double>(weights.size());
    while (!(cdf_[i + 1] > u)) ++i;
    start_.push_back(i);
  }
}

Distribution1D::Sample Distribution1D::sample(float u) const {
  if (total_ == 0) return {};
  // The first i with cdf[i + 1] > u: then cdf[i] <= u, so the chosen weight is positive.
  std::size_t i = start_[static_cast<std::size_t>(u * static_cast<double>(start_.size()))];
  while (cdf_[i] > u) --i;  // u times n was rounded up to the next cell
  while (!(cdf_[i + 1] > u)) ++i;
  const double width = cdf_[i + 1] - cdf_[i];
  const auto rest = static_cast<float>((u - cdf_[i]) / width);
  return {static_cast<int>(i), static_cast<float>(width), std::min(rest, kOneMinusEpsilon)};
}

float Distribution1D::pmf(int index) const {
  return static_cast<float>(cdf_[index + 1] - cdf_[index]);
}

Distribution2D::Distribution2D(std::span<const double> weights, int width, int height) {
  OCTOLUX_CHECK(weights.size() == static_cast<std::size_t>(width) * height);
  std::vector<double> sums;
  columns_.reserve(height);
  for (int y = 0; y < height; ++y) {
    columns_.emplace_back(weights.subspan(static_cast<std::size_t>(y) * width, width));
    sums.push_back(columns_.back().total());
  }
  rows_ = Distribution1D(sums);
}

Distribution2D::Sample Distribution2D::sample(Vec2 u) const {
  const Distribution1D::Sample row = rows_.sample(u.y);
  if (row.pmf == 0) return {};
  const Distribution1D::Sample column = columns_[row.index].sample(u.x);
  return {column.index, row.index, row.pmf * column.pmf, {column.u, row.u}};
}

}  // namespace octolux
