// How far an image x is from a reference y: DESIGN.md's measures, each with its formula. Means run
// over pixels and channels of the mask; x and y are scene-linear, nothing is clamped but for PSNR.
//
// A pixel with a NaN or an infinity in either picture is counted and left out of every measure.
// Sums are made in double, in fixed chunks joined in order: the same digits on any number of
// threads. Thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tools/compare/layer_view.h"
#include "tools/compare/mask.h"

namespace octolux {

/// Added to y^2 (and, unsquared, to |y| or |x| + |y|) so that black does not count infinitely.
inline constexpr double kMetricEpsilon = 0.01;
/// The share of pixels, the worst ones, that the trimmed relMSE leaves out.
inline constexpr double kTrimmedShare = 0.001;

struct BadValues {
  std::int64_t nan = 0, infinite = 0;  // pixels with at least one; NaN goes first
  std::int64_t negative = 0;           // finite values
  std::int64_t first = -1;             // first pixel that is not finite; -1: none

  std::int64_t non_finite() const { return nan + infinite; }
};

/// The mean square error split in two. An estimate: the variances are.
struct NoiseSplit {
  double variance_image = 0, variance_reference = 0;  // means; 0 where not known
  double bias2 = 0;                                   // max(0, MSE - both)
  bool image_known = false, reference_known = false;
};

struct Metrics {
  std::int64_t pixels = 0;  // that count: in the mask, and finite in both
  double mse = 0, rmse = 0, mae = 0;
  double rel_mse = 0, trimmed_rel_mse = 0, mrse = 0, smape = 0;
  double psnr = 0;  // [dB]; infinite for equal pictures
  double mean_image = 0, mean_reference = 0;
  double mean_ratio = 0;                   // NaN over a black reference
  double light_leak = 0, shadow_leak = 0;  // the same
  BadValues image, reference;
  std::optional<NoiseSplit> noise;  // if a variance is known
};

/// Throws Error as check_comparable; `mask` has the pictures' size or is empty.
Metrics measure_error(const LayerView& reference, const LayerView& image, const Mask& mask = {});

/// Sum of `errors` (each >= 0) without the `dropped` largest.
double sum_without_largest(std::span<const float> errors, std::int64_t dropped);

}  // namespace octolux
