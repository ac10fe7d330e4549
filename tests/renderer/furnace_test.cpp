// The furnace: a closed room whose walls all have reflectance rho and emit Le = 1 shows the
// radiance Le / (1 - rho) = 1 + rho + rho^2 + ... everywhere, edges and corners included.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

std::string furnace(const std::string& shape, double rho, const std::string& sensor) {
  return "<scene version='3.0.0'>" + sensor + "<shape type='" + shape +
         "'><boolean name='flip_normals' value='true'/><bsdf type='diffuse'>"
         "<rgb name='reflectance' value='" +
         std::to_string(rho) +
         "'/></bsdf><emitter type='area'><rgb name='radiance' "
         "value='1'/></emitter></shape></scene>";
}

/// Looks at the whole of one wall and its neighbours, or closely at an edge or a corner.
const std::string kViews[] = {
    sensor_xml("0.2, 0.1, 0.3", "-1, 0.3, 0.1", 90, 8, 8),
    sensor_xml("0.2, 0.1, 0.3", "1, 1, 0.1", 0.5, 8, 8),
    sensor_xml("0.2, 0.1, 0.3", "-1, -1, -1", 0.5, 8, 8),
};

class Furnace : public testing::TestWithParam<double> {};

TEST_P(Furnace, PathTracerIsExact) {
  const double rho = GetParam();
  for (const std::string shape : {"cube", "sphere"}) {
    for (const std::string& view : kViews) {
      const auto scene = scene_from(furnace(shape, rho, view));
      const MeanRadiance seen = mean_radiance(render_film(*scene, path_config(64)));
      // With every wall alike next-event estimation and BSDF sampling both see Le = 1: what is left
      // of the variance is roulette's and the heuristic's.
      EXPECT_NEAR(seen.mean, 1 / (1 - rho), 4.5 * seen.standard_error + 1e-5) << shape << view;
    }
  }
}

TEST_P(Furnace, FinalGatherWithinOnePercentEvenInCorners) {
  const double rho = GetParam();
  for (const std::string shape : {"cube", "sphere"}) {
    for (const std::string& view : kViews) {
      const auto scene = scene_from(furnace(shape, rho, view));
      resize_film(*scene, 14, 14);
      const Running seen = pass_means(*scene, photon_config(16, rho < 0.9 ? 50'000 : 40'000));
      EXPECT_NEAR(seen.mean() * (1 - rho), 1, 0.01) << shape << view;
      EXPECT_LT(seen.standard_error() * (1 - rho), 0.005) << shape << view;
    }
  }
}

TEST_P(Furnace, DirectViewOfTheMapIsDarkInCorners) {
  // The shadow leak of the paper's figure 1: reported, and bounded by what geometry allows (a wall
  // keeps half of the disc, a corner of a room a quarter; the rest of the light is the walls' own).
  const double rho = GetParam();
  for (const std::string kernel : {"disc", "cone"}) {
    double seen[3], error = 0;
    for (int view = 0; view < 3; ++view) {
      const auto scene = scene_from(furnace("cube", rho, kViews[view]));
      RenderConfig config = photon_config(64, rho < 0.9 ? 10'000 : 3'000);
      config.eye.gather = false;
      config.estimator.kernel = kernel;
      config.estimator.neighbours = 50;
      const Running passes = pass_means(*scene, config);
      seen[view] = passes.mean() * (1 - rho);
      error = std::max(error, passes.standard_error() * (1 - rho));
    }
    std::printf("  gather off, %s, rho %.1f: wall %.3f, edge %.3f, corner %.3f of the truth\n",
                kernel.c_str(), rho, seen[0], seen[1], seen[2]);
    EXPECT_LT(seen[2], seen[1] - 4 * error);
    EXPECT_LT(seen[1], seen[0] - 4 * error);
    EXPECT_LT(seen[0], 1 + 4 * error);
    EXPECT_GT(seen[2], 1 - rho + 0.25 * rho - 4 * error);
  }
}

INSTANTIATE_TEST_SUITE_P(Reflectance, Furnace, testing::Values(0.2, 0.5, 0.9));

}  // namespace
}  // namespace octolux::test
