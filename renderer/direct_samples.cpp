// direct_samples.h.
#include "renderer/direct_samples.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace octolux {

namespace {

/// An eye sample that gathers costs so many that do not: in eleven scenes 6 to 17.
constexpr double kCosts = 10;
constexpr int kMostDirectSamples = 15;
/// Of the picture's mean, added to each pixel's: what errors are relative to, as in
/// Film::relative_error().
constexpr double kFloor = 0.01;

/// Of the first two passes, if they are to tell how many are wanted. They weigh as much as later
/// passes, so they should not have many fewer.
constexpr std::int64_t kAtFirst = 2;

}  // namespace

std::int64_t first_direct_samples(const RenderConfig& config) {
  if (config.integrator == Integrator::path || !config.eye.gather) return 0;
  return config.eye.direct_samples < 0 ? kAtFirst : config.eye.direct_samples;
}

std::int64_t wanted_direct_samples(const Film& first, const PassImage& second, std::int64_t taken) {
  OCTOLUX_CHECK(first.passes() == 1);
  const Image radiance = first.radiance(), indirect = first.indirect();
  double mean = 0;
  for (const Rgb& pixel : radiance.pixels) mean += luminance(pixel);
  mean /= static_cast<double>(second.size());

  double direct_variance = 0, indirect_variance = 0;  // of a pass, times 2 and the pixels
  for (std::size_t i = 0; i < second.size(); ++i) {
    const double before = luminance(radiance.pixels[i]), after = luminance(second[i].radiance());
    const double scale = std::max(0.0, (before + after) / 2) + kFloor * mean;
    if (!(scale > 0)) continue;
    const double by_indirect =
        (luminance(second[i].indirect) - luminance(indirect.pixels[i])) / scale;
    const double by_direct = (after - before) / scale - by_indirect;
    // A pixel that is nothing but noise counts as such: not as a thousand.
    direct_variance += std::min(1.0, by_direct * by_direct);
    indirect_variance += std::min(1.0, by_indirect * by_indirect);
  }
  const double of_one = direct_variance * static_cast<double>(1 + taken);
  if (!(of_one > 0)) return 0;
  const double wanted = std::sqrt(kCosts * of_one / indirect_variance) - 1;
  return std::lround(std::clamp<double>(wanted, 0, kMostDirectSamples));
}

}  // namespace octolux
