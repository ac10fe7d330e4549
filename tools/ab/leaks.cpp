// leaks.h. One thread: two sums over pixels are cheap beside everything else that is done to them.
#include "tools/ab/leaks.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace octolux {
namespace {

bool is_finite(const LayerView& view, std::size_t pixel) {
  for (const auto& plane : view.planes) {
    if (!std::isfinite(plane[pixel])) return false;
  }
  return true;
}

double variance_of(const LayerView& view, std::size_t channel, std::size_t pixel) {
  return view.variance.empty() ? 0 : static_cast<double>(view.variance[channel][pixel]);
}

struct Sums {
  double light = 0, shadow = 0, noise = 0;
};

void add_pixel(Sums& sums, const LayerView& reference, const LayerView& image, std::size_t i) {
  for (std::size_t c = 0; c < reference.planes.size(); ++c) {
    const double d =
        static_cast<double>(image.planes[c][i]) - static_cast<double>(reference.planes[c][i]);
    sums.light += std::max(0.0, d);
    sums.shadow += std::max(0.0, -d);
    sums.noise += std::sqrt(variance_of(reference, c, i) + variance_of(image, c, i));
  }
}

}  // namespace

LeakFigures measure_leaks(const LayerView& reference, const LayerView& image, const Mask& mask) {
  check_comparable(reference, image);
  LeakFigures figures;
  Sums sums;
  double y = 0;
  std::int64_t pixels = 0;
  for (std::size_t i = 0; i < reference.pixels(); ++i) {
    if (!is_finite(reference, i) || !is_finite(image, i)) continue;
    for (const auto& plane : reference.planes) y += static_cast<double>(plane[i]);
    ++pixels;
    if (!counts(mask, i)) continue;
    add_pixel(sums, reference, image, i);
    ++figures.pixels;
  }
  const double black = y == 0 ? std::numeric_limits<double>::quiet_NaN() : 1;
  const double unit = black * y * static_cast<double>(figures.pixels) / static_cast<double>(pixels);
  figures.light = sums.light / unit;
  figures.shadow = sums.shadow / unit;
  if (!reference.variance.empty() || !image.variance.empty()) {
    figures.noise = sums.noise / std::sqrt(2 * std::numbers::pi) / unit;
  }
  return figures;
}

ScalarField leak_field(const LayerView& reference, const LayerView& image) {
  ScalarField field{reference.width, reference.height, {}};
  double mean = 0;
  std::int64_t pixels = 0;
  for (std::size_t i = 0; i < reference.pixels(); ++i) {
    const float x = grey(image, i), y = grey(reference, i);
    field.values.push_back(x - y);
    if (!std::isfinite(x - y)) continue;
    mean += static_cast<double>(y);
    ++pixels;
  }
  mean /= static_cast<double>(pixels);
  for (float& v : field.values) {
    v = std::isfinite(v) ? static_cast<float>(static_cast<double>(v) / mean)
                         : std::numeric_limits<float>::quiet_NaN();
  }
  return field;
}

}  // namespace octolux
