// Leaks in figures and as a field: the signed error of a picture, in units of the reference's mean
// over the whole image, so that dark places do not count more than bright ones and a sealed room,
// where the reference is 0, can be measured. Thread-safe.
#pragma once

#include <cstdint>
#include <optional>

#include "tools/compare/heat_map.h"
#include "tools/compare/mask.h"

namespace octolux {

struct LeakFigures {
  std::int64_t pixels = 0;  // of the mask, finite in both pictures
  double light = 0;         // mean max(0, x - y) / mean y; NaN over a black reference
  double shadow = 0;        // mean max(0, y - x) / mean y; the same
  // What each of them would be expected to read were there nothing but noise: mean s / sqrt(2 pi) /
  // mean y with s^2 the variance of x - y. Empty: no variance is known.
  std::optional<double> noise;
};

/// Means of the numerators run over the mask, that of the denominator over the image.
LeakFigures measure_leaks(const LayerView& reference, const LayerView& image, const Mask& mask);

/// (x - y) / mean y of luminance; NaN where either is not finite.
ScalarField leak_field(const LayerView& reference, const LayerView& image);

}  // namespace octolux
