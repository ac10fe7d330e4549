// The gate: is the mean of every tile of 8 x 8 pixels, and of the whole picture, where the
// reference and the kernel's stated bias allow it to be? One-sided t-tests for both ends of the
// allowed interval, with the spread of the batches and the variance of the reference, held together
// by Sidak's correction. Pure functions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/regression/batches.h"
#include "tests/stats.h"

namespace octolux::test {

inline constexpr int kTile = 8;               // pixels
inline constexpr int kFewestPixels = 12;      // of a tile, that it says something
inline constexpr double kGateAlpha = kAlpha;  // of one render: a false alarm in 10 000

/// Where the expected picture may lie, per pixel and channel, and its reference's variance.
struct Allowed {
  Image low, high, variance;
  std::vector<char> counts;  // per pixel; 0: not tested
};

struct Region {
  int x = 0, y = 0;                 // of the tile; -1: the whole picture
  std::vector<std::size_t> pixels;  // that count
};

inline std::vector<Region> regions_of(const Allowed& allowed) {
  const int width = allowed.low.width, height = allowed.low.height;
  std::vector<Region> tiles;
  Region whole{-1, -1, {}};
  for (int y = 0; y < height; y += kTile) {
    for (int x = 0; x < width; x += kTile) {
      Region tile{x, y, {}};
      for (int j = y; j < std::min(y + kTile, height); ++j) {
        for (int i = x; i < std::min(x + kTile, width); ++i) {
          const std::size_t pixel = static_cast<std::size_t>(j) * width + i;
          if (allowed.counts[pixel]) tile.pixels.push_back(pixel);
        }
      }
      whole.pixels.insert(whole.pixels.end(), tile.pixels.begin(), tile.pixels.end());
      if (static_cast<int>(tile.pixels.size()) >= kFewestPixels) tiles.push_back(std::move(tile));
    }
  }
  if (!whole.pixels.empty()) tiles.push_back(std::move(whole));
  return tiles;
}

inline double region_mean(const Image& image, const Region& region, int channel) {
  double sum = 0;
  for (const std::size_t pixel : region.pixels) sum += image.pixels[pixel][channel];
  return sum / static_cast<double>(region.pixels.size());
}

struct GateResult {
  int tests = 0, failed = 0;
  double worst_p = 1;
  std::string worst;  // in words

  bool passed() const { return tests > 0 && failed == 0; }
};

/// One channel of a region: the tests of both ends.
inline void test_region(const Batches& batches, const Allowed& allowed, const Region& region,
                        int channel, double limit, GateResult& result) {
  Running mean;
  for (const Image& image : batches.radiance) mean.add(region_mean(image, region, channel));
  const auto n = static_cast<double>(region.pixels.size());
  const double reference_variance = region_mean(allowed.variance, region, channel) / n;
  const double low = region_mean(allowed.low, region, channel);
  const double high = region_mean(allowed.high, region, channel);
  const double variance = mean.variance_of_mean() + reference_variance;
  const double beyond = std::max(low - mean.mean(), mean.mean() - high);
  const double dof = welch_dof(mean.variance_of_mean(), kBatches, reference_variance, INFINITY);
  double p = 1;
  if (beyond > 0) p = variance > 0 ? student_t_p(beyond / std::sqrt(variance), dof) / 2 : 0;
  result.tests += 2;
  result.failed += p < limit;
  if (!(p < result.worst_p)) return;
  result.worst_p = p;
  char text[200];
  std::snprintf(text, sizeof text, "%s %d,%d channel %c: %.5g +- %.2g, allowed %.5g to %.5g",
                region.x < 0 ? "picture" : "tile at", std::max(0, region.x), std::max(0, region.y),
                "RGB"[channel], mean.mean(), std::sqrt(variance), low, high);
  result.worst = text;
}

inline GateResult check_gate(const Batches& batches, const Allowed& allowed) {
  const std::vector<Region> regions = regions_of(allowed);
  const double limit = sidak(kGateAlpha, 6 * static_cast<double>(regions.size()));
  GateResult result;
  for (const Region& region : regions) {
    for (int channel = 0; channel < 3; ++channel) {
      test_region(batches, allowed, region, channel, limit, result);
    }
  }
  return result;
}

}  // namespace octolux::test
