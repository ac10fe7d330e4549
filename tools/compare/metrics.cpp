// metrics.h. One pass reads both pictures and sums everything; the trimmed mean then looks at the
// errors of the pixels once more, which that pass left behind.
#include "tools/compare/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace octolux {
namespace {

constexpr std::int64_t kChunk = 1 << 14;  // pixels

struct Sums {
  double square = 0, absolute = 0, rel = 0, mrse = 0, smape = 0, clamped = 0;
  double image = 0, reference = 0, light = 0, shadow = 0;
  double variance_image = 0, variance_reference = 0;
  std::int64_t pixels = 0;
  BadValues bad_image, bad_reference;
};

void add(BadValues& sum, const BadValues& part) {
  sum.nan += part.nan;
  sum.infinite += part.infinite;
  sum.negative += part.negative;
  if (sum.first < 0) sum.first = part.first;
}

void add(Sums& sum, const Sums& part) {
  for (const auto member : {&Sums::square, &Sums::absolute, &Sums::rel, &Sums::mrse, &Sums::smape,
                            &Sums::clamped, &Sums::image, &Sums::reference, &Sums::light,
                            &Sums::shadow, &Sums::variance_image, &Sums::variance_reference}) {
    sum.*member += part.*member;
  }
  sum.pixels += part.pixels;
  add(sum.bad_image, part.bad_image);
  add(sum.bad_reference, part.bad_reference);
}

/// Looks at one pixel; false if a channel is not finite.
bool inspect(const LayerView& view, std::int64_t pixel, BadValues& bad) {
  bool nan = false, infinite = false;
  for (const auto& plane : view.planes) {
    const float v = plane[pixel];
    nan |= std::isnan(v);
    infinite |= std::isinf(v);
    bad.negative += v < 0 && !std::isinf(v);
  }
  if (!nan && !infinite) return true;
  if (bad.first < 0) bad.first = pixel;
  ++(nan ? bad.nan : bad.infinite);
  return false;
}

double clamp01(double v) { return std::min(std::max(v, 0.0), 1.0); }

/// Adds one value; returns its relative square error.
double add_value(Sums& sums, double x, double y) {
  const double d = x - y, square = d * d, magnitude = std::abs(d);
  const double rel = square / (y * y + kMetricEpsilon);
  const double denominator = y + kMetricEpsilon, shown = clamp01(x) - clamp01(y);
  sums.square += square;
  sums.absolute += magnitude;
  sums.rel += rel;
  sums.mrse += square / (denominator * denominator);
  sums.smape += magnitude / (std::abs(x) + std::abs(y) + kMetricEpsilon);
  sums.clamped += shown * shown;
  sums.image += x;
  sums.reference += y;
  sums.light += std::max(0.0, d);
  sums.shadow += std::max(0.0, -d);
  return rel;
}

double variance_at(const LayerView& view, std::int64_t pixel) {
  double sum = 0;
  for (const auto& plane : view.variance) sum += static_cast<double>(plane[pixel]);
  return sum;
}

/// A pair of pictures under measurement.
struct Pair {
  const LayerView& reference;
  const LayerView& image;
  const Mask& mask;

  /// Sums over pixels [begin, end); `errors` receives each pixel's relMSE, or -1 if it is left out.
  Sums sum(std::int64_t begin, std::int64_t end, std::vector<float>& errors) const {
    Sums sums;
    const std::size_t channels = reference.planes.size();
    for (std::int64_t i = begin; i < end; ++i) {
      errors[i] = -1;
      if (!counts(mask, static_cast<std::size_t>(i))) continue;
      const bool image_good = inspect(image, i, sums.bad_image);
      const bool reference_good = inspect(reference, i, sums.bad_reference);
      if (!image_good || !reference_good) continue;
      double rel = 0;
      for (std::size_t c = 0; c < channels; ++c) {
        rel += add_value(sums, static_cast<double>(image.planes[c][i]),
                         static_cast<double>(reference.planes[c][i]));
      }
      errors[i] = static_cast<float>(rel / static_cast<double>(channels));
      sums.variance_image += variance_at(image, i);
      sums.variance_reference += variance_at(reference, i);
      ++sums.pixels;
    }
    return sums;
  }
};

NoiseSplit split_noise(const Pair& pair, const Sums& sums, double mse, double values) {
  NoiseSplit split;
  split.image_known = !pair.image.variance.empty();
  split.reference_known = !pair.reference.variance.empty();
  split.variance_image = sums.variance_image / values;
  split.variance_reference = sums.variance_reference / values;
  const double rest = mse - split.variance_image - split.variance_reference;
  split.bias2 = rest < 0 ? 0 : rest;  // NaN stays
  return split;
}

Metrics means_of(const Sums& sums, double values) {
  Metrics m;
  m.pixels = sums.pixels;
  m.image = sums.bad_image;
  m.reference = sums.bad_reference;
  m.mse = sums.square / values;
  m.rmse = std::sqrt(m.mse);
  m.mae = sums.absolute / values;
  m.rel_mse = sums.rel / values;
  m.mrse = sums.mrse / values;
  m.smape = 2 * sums.smape / values;
  m.psnr = 10 * std::log10(values / sums.clamped);
  m.mean_image = sums.image / values;
  m.mean_reference = sums.reference / values;
  // A quotient over black says nothing.
  const double black = sums.reference == 0 ? std::numeric_limits<double>::quiet_NaN() : 1;
  m.mean_ratio = black * sums.image / sums.reference;
  m.light_leak = black * sums.light / sums.reference;
  m.shadow_leak = black * sums.shadow / sums.reference;
  return m;
}

double trimmed_mean(std::vector<float>& errors, std::int64_t pixels) {
  if (static_cast<std::size_t>(pixels) < errors.size()) std::erase(errors, -1.0f);
  const auto dropped = static_cast<std::int64_t>(kTrimmedShare * static_cast<double>(pixels));
  return sum_without_largest(errors, dropped) / static_cast<double>(pixels - dropped);
}

}  // namespace

Metrics measure_error(const LayerView& reference, const LayerView& image, const Mask& mask) {
  check_comparable(reference, image);
  const Pair pair{reference, image, mask};
  const auto pixels = static_cast<std::int64_t>(reference.pixels());
  std::vector<Sums> parts(static_cast<std::size_t>((pixels + kChunk - 1) / kChunk));
  std::vector<float> errors(static_cast<std::size_t>(pixels));
  parallel_for_chunks(pixels, kChunk,
                      [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
                        parts[chunk] = pair.sum(begin, end, errors);
                      });
  Sums sums;
  for (const Sums& part : parts) add(sums, part);
  const double values =
      static_cast<double>(sums.pixels) * static_cast<double>(reference.planes.size());
  Metrics m = means_of(sums, values);
  m.trimmed_rel_mse = trimmed_mean(errors, sums.pixels);
  if (!image.variance.empty() || !reference.variance.empty()) {
    m.noise = split_noise(pair, sums, m.mse, values);
  }
  return m;
}

}  // namespace octolux
