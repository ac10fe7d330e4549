// Makes estimators/octobox_table.inc: simulates the corrected OctoBox estimate on an open plane.
// Given the bandwidth, n photons of a look-up are uniform in its disc, so that is all there is to
// simulate. Usage: build/make_octobox_table > estimators/octobox_table.inc (about three minutes on
// two processors; the same numbers on any number of them).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/constants.h"
#include "core/parallel.h"
#include "core/rng.h"
#include "estimators/octobox_fit.h"

namespace octolux {
namespace {

constexpr OctantUse kUses[] = {OctantUse::one, OctantUse::eight, OctantUse::automatic};
constexpr int kPhotons[] = {4,   5,   6,   7,   8,   9,   10,   11,   12,   13,  14,  15,  16,
                            18,  20,  22,  24,  26,  28,  30,   32,   35,   38,  41,  45,  50,
                            55,  60,  66,  73,  80,  90,  100,  115,  130,  150, 175, 200, 230,
                            270, 320, 400, 500, 640, 800, 1000, 1300, 1600, 2000};
constexpr std::int64_t kChunk = 500;

struct Sums {
  std::array<double, 3> sum{}, square{};
};

void fill_disc(PlanePoints& points, int count, Rng& rng) {
  points.resize(count);
  for (int i = 0; i < count;) {
    const Vec2 u = rng.uniform2();
    const Vec2 p{2 * u.x - 1, 2 * u.y - 1};
    if (p.x * p.x + p.y * p.y < 1) points.set(i++, p, true);
  }
}

Sums simulate(int photons, std::int64_t begin, std::int64_t end) {
  Sums sums;
  PlanePoints drawn, points;
  for (std::int64_t run = begin; run < end; ++run) {
    Rng rng(1, Stream::test, static_cast<std::uint64_t>(photons), static_cast<std::uint64_t>(run));
    fill_disc(drawn, photons, rng);
    for (std::size_t k = 0; k < 3; ++k) {
      points = drawn;
      const Fit fit = fit_octobox(points, 1, kUses[k]);
      const double ratio = fit.area > 0 ? fit.count / fit.area * kPi / photons : 0;
      sums.sum[k] += ratio;
      sums.square[k] += ratio * ratio;
    }
  }
  return sums;
}

/// Runs that bring the standard error to about 2e-4; fewer at few photons, where the box hardly
/// counts.
std::int64_t runs_for(int photons) {
  const double deviation = 5.4 / photons;  // of one run, about
  const double runs = std::pow(deviation / 2e-4, 2);
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(runs), 10000, 1000000);
}

void print_entry(int photons) {
  const std::int64_t runs = runs_for(photons);
  std::vector<Sums> parts(static_cast<std::size_t>((runs + kChunk - 1) / kChunk));
  parallel_for_chunks(runs, kChunk, [&](std::int64_t c, std::int64_t begin, std::int64_t end) {
    parts[static_cast<std::size_t>(c)] = simulate(photons, begin, end);
  });
  std::array<double, 3> mean{}, error{};
  for (std::size_t k = 0; k < 3; ++k) {
    double square = 0;
    for (const Sums& part : parts) mean[k] += part.sum[k], square += part.square[k];
    mean[k] /= static_cast<double>(runs);
    const double variance = square / static_cast<double>(runs) - mean[k] * mean[k];
    error[k] = std::sqrt(variance / static_cast<double>(runs));
  }
  fmt::print("{{{}, {{{:.5f}, {:.5f}, {:.5f}}}, {{{:.5f}, {:.5f}, {:.5f}}}}},\n", photons, mean[0],
             mean[1], mean[2], error[0], error[1], error[2]);
  std::fflush(stdout);
}

}  // namespace
}  // namespace octolux

int main() {
  fmt::print(
      "// Made by build/make_octobox_table: photons, ratios (one box, one per octant,\n"
      "// automatic), their standard errors.\n");
  for (const int photons : octolux::kPhotons) octolux::print_entry(photons);
}
