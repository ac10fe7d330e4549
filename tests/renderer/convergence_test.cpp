// Progressive photon mapping converges: its error against the path tracer falls on a log-log line
// without a floor, because each pass's bandwidth is smaller than the last one's.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// Mean over pixels and channels of variance / (reference^2 + 0.01): what relMSE owes to noise.
double rel_variance(const Film& film, const Image& reference) {
  const Image variance = film.variance();
  double sum = 0;
  for (std::size_t i = 0; i < variance.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double y = reference.pixels[i][c];
      sum += variance.pixels[i][c] / (y * y + 0.01);
    }
  }
  return sum / (3.0 * static_cast<double>(variance.pixels.size()));
}

/// Slope of log(error) over log(passes), least squares.
double slope(const std::vector<double>& passes, const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(passes.size());
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const double x = std::log(passes[i]), y = std::log(error[i]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

struct Mode {
  const char* name;
  bool gather;
  const char* kernel;
  double slope;  // at least this steep
};

class ConvergenceSlow : public testing::TestWithParam<Mode> {};

TEST_P(ConvergenceSlow, NoFloorOverThreeOctavesPastSixtyFourPasses) {
  const auto scene = shipped_scene("cornell/cornell.xml");
  resize_film(*scene, 24, 24);
  const Film reference = render_film(*scene, path_config(60'000));
  const Image truth = reference.radiance();
  const double noise_of_truth = rel_variance(reference, truth);

  RenderConfig config = photon_config(1024, 10'000);
  config.eye.gather = GetParam().gather;
  config.estimator.kernel = GetParam().kernel;
  std::vector<double> passes, error;
  Watch watch([&](const Progress& p, const Film& film) {
    if (p.passes < 64 || (p.passes & (p.passes - 1)) != 0) return;
    passes.push_back(p.passes);
    error.push_back(rel_mse(film.radiance(), truth) - noise_of_truth);
    std::printf("  %s: %4d passes, relMSE %.3g\n", GetParam().name, p.passes, error.back());
  });
  render(*scene, config, watch);
  ASSERT_EQ(passes.size(), 5u);
  const double fitted = slope(passes, error);
  std::printf("  %s: slope %.3f (noise of the reference %.2g)\n", GetParam().name, fitted,
              noise_of_truth);
  // Knaus & Zwicker: variance and squared bias both fall as k^(-2/3) for alpha = 2/3. Seen
  // directly, the cone is wrong by O(1) within h of every wall, and the area of that band falls as
  // h, k^(-1/6): slower, but no floor. A floor would flatten the line over the last octave.
  EXPECT_LT(fitted, GetParam().slope);
  EXPECT_LT(error[4] / error[3], std::pow(2.0, 0.6 * GetParam().slope));
}

INSTANTIATE_TEST_SUITE_P(Modes, ConvergenceSlow,
                         testing::Values(Mode{"gathered", true, "cone", -0.5},
                                         Mode{"direct", false, "cone", -0.3},
                                         Mode{"region", false, "region", -0.5}),
                         [](const testing::TestParamInfo<Mode>& param) {
                           return param.param.name;
                         });

}  // namespace
}  // namespace octolux::test
