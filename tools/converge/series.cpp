// series.h. Sums over pixels run in one order in double: the same digits on any number of threads.
#include "tools/converge/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/statistics.h"
#include "tools/compare/metrics.h"

namespace octolux {
namespace {

/// What the seeds' spread is made from.
struct Spread {
  double floor = 0;
  double noise2 = 0;                // of all seeds
  std::vector<double> noise2_less;  // of all seeds but one
  std::int64_t non_finite = 0;
};

struct Views {
  LayerView reference;
  std::vector<LayerView> images;

  bool finite(std::size_t pixel) const {
    for (std::size_t c = 0; c < reference.planes.size(); ++c) {
      if (!std::isfinite(reference.planes[c][pixel])) return false;
      for (const LayerView& image : images) {
        if (!std::isfinite(image.planes[c][pixel])) return false;
      }
    }
    return true;
  }
};

/// Unbiased variance from a sum and a sum of squares about some value near the mean.
double variance(double sum, double square, double n) {
  return n < 2 ? 0 : std::max(0.0, (square - sum * sum / n) / (n - 1));
}

/// Adds the value of one pixel and channel.
void add_value(Spread& spread, const Views& views, std::size_t channel, std::size_t pixel) {
  const double y = views.reference.planes[channel][pixel];
  const double weight = 1 / (y * y + kMetricEpsilon);
  const auto seeds = static_cast<double>(views.images.size());
  if (!views.reference.variance.empty()) {
    spread.floor += weight * views.reference.variance[channel][pixel];
  }
  const double centre = views.images.front().planes[channel][pixel];
  double sum = 0, square = 0;
  for (const LayerView& image : views.images) {
    const double d = image.planes[channel][pixel] - centre;
    sum += d, square += d * d;
  }
  spread.noise2 += weight * variance(sum, square, seeds);
  for (std::size_t r = 0; r < views.images.size(); ++r) {
    const double d = views.images[r].planes[channel][pixel] - centre;
    spread.noise2_less[r] += weight * variance(sum - d, square - d * d, seeds - 1);
  }
}

Spread measure_spread(const Views& views) {
  Spread spread;
  spread.noise2_less.resize(views.images.size());
  const std::size_t channels = views.reference.planes.size();
  std::size_t values = 0;
  for (std::size_t pixel = 0; pixel < views.reference.pixels(); ++pixel) {
    if (!views.finite(pixel)) {
      ++spread.non_finite;
      continue;
    }
    values += channels;
    for (std::size_t c = 0; c < channels; ++c) add_value(spread, views, c, pixel);
  }
  const double scale = values > 0 ? 1 / static_cast<double>(values) : 0;
  spread.floor *= scale;
  spread.noise2 *= scale;
  for (double& noise2 : spread.noise2_less) noise2 *= scale;
  return spread;
}

/// Mean of w times the picture's own variance; empty if it has none, or only zeros.
std::optional<double> own_noise(const Views& views) {
  const LayerView& image = views.images.front();
  if (image.variance.empty()) return std::nullopt;
  double sum = 0;
  std::size_t values = 0;
  for (std::size_t c = 0; c < image.planes.size(); ++c) {
    for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel) {
      if (!views.finite(pixel)) continue;
      const double y = views.reference.planes[c][pixel];
      sum += image.variance[c][pixel] / (y * y + kMetricEpsilon);
      ++values;
    }
  }
  if (!(sum > 0)) return std::nullopt;
  return sum / static_cast<double>(values);
}

/// Noise and bias from the seeds' spread. With few seeds the standard error of bias^2 is itself
/// uncertain, with two it is hardly known, so it takes three.
void split_error(SeriesPoint& point, const Spread& spread) {
  const auto n = static_cast<double>(point.seeds.size());
  point.noise2 = spread.noise2;
  point.bias2 = point.rel_mse - point.floor - spread.noise2;
  if (point.seeds.size() < 3) return;
  Running jackknife;
  for (std::size_t r = 0; r < point.seeds.size(); ++r) {
    const double rel_mse = (n * point.rel_mse - point.seeds[r].rel_mse) / (n - 1);
    jackknife.add(rel_mse - spread.noise2_less[r]);
  }
  point.bias2_error = (n - 1) * jackknife.standard_error();
}

}  // namespace

double SeriesPoint::error() const { return std::sqrt(std::max(0.0, rel_mse - floor)); }

SeriesPoint measure_point(const NamedPicture& reference,
                          const std::vector<TimedPicture>& pictures) {
  std::vector<NamedPicture> loaded;
  loaded.reserve(pictures.size());
  Views views{view_layer(reference), {}};
  SeriesPoint point;
  point.passes = pictures.front().passes;
  Running rel_mse, trimmed, ratio, seconds;
  for (const TimedPicture& picture : pictures) {
    loaded.push_back(load_picture(picture.file, {""}));
    views.images.push_back(view_layer(loaded.back()));
    const Metrics m = measure_error(views.reference, views.images.back());
    point.seeds.push_back(
        {picture.file, picture.seconds, m.rel_mse, m.trimmed_rel_mse, m.mean_ratio});
    rel_mse.add(m.rel_mse), trimmed.add(m.trimmed_rel_mse);
    ratio.add(m.mean_ratio), seconds.add(picture.seconds);
  }
  const Spread spread = measure_spread(views);
  point.seconds = seconds.mean();
  point.rel_mse = rel_mse.mean();
  point.trimmed_rel_mse = trimmed.mean();
  point.mean_ratio = ratio.mean();
  point.floor = spread.floor;
  point.non_finite = spread.non_finite;
  const bool several = pictures.size() > 1;
  point.rel_mse_error =
      several ? rel_mse.standard_error() : std::numeric_limits<double>::quiet_NaN();
  if (several) {
    split_error(point, spread);
  } else if ((point.noise2 = own_noise(views))) {
    point.bias2 = point.rel_mse - point.floor - *point.noise2;
  }
  return point;
}

}  // namespace octolux
