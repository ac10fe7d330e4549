// Passes complement each other: where they were independent, several renders would differ as much
// as the spread of their passes tells.
#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

TEST(PixelSequences, PassesErrLessTogetherThanIndependentOnesWould) {
  auto scene = shipped_scene("cornell/cornell.xml");
  resize_film(*scene, 16, 16);
  RenderConfig config;
  config.photons.global = 5000;
  config.stop.passes = 16;
  constexpr int kRenders = 8;
  std::vector<Running> pixels(16 * 16);
  Running claimed;
  for (int i = 0; i < kRenders; ++i) {
    config.seed = static_cast<std::uint64_t>(i) + 1;
    Watch watch;
    const Film film = render(*scene, config, watch).film;
    const Image radiance = film.radiance();
    const Image variance = film.variance();
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      pixels[p].add(radiance.pixels[p].g);
      claimed.add(variance.pixels[p].g);
    }
  }
  Running observed;
  for (const Running& pixel : pixels) observed.add(pixel.variance());
  EXPECT_LT(observed.mean() + 4 * observed.standard_error(), claimed.mean());
}

}  // namespace
}  // namespace octolux::test
