// Passes complement each other: where they were independent, several renders would differ as much
// as the spread of their passes tells.
#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// A floor without edges in the picture, whose own filter's samples cannot help, under a lamp and
/// between walls that pass its light on.
std::unique_ptr<Scene> even_floor(int size) {
  return scene_from("<scene version='3.0.0'>" +
                    sensor_xml("0, 1, 0.01", "0, 0, 0", 20, size, size) + R"(
    <shape type='cube'><transform name='to_world'><scale value='-2'/><translate y='2'/></transform>
      <bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf></bsdf>
    </shape>
    <shape type='rectangle'>
      <transform name='to_world'><rotate x='1' angle='90'/><translate y='2' x='0.5'/></transform>
      <emitter type='area'><rgb name='radiance' value='1'/></emitter></shape></scene>)");
}

TEST(PixelSequences, PassesErrLessTogetherThanIndependentOnesWould) {
  constexpr int kSize = 12, kRenders = 8;
  const auto scene = even_floor(kSize);
  std::vector<Running> pixels(kSize * kSize);
  Running claimed;
  for (int i = 0; i < kRenders; ++i) {
    RenderConfig config = photon_config(16, 5'000);
    config.seed = static_cast<std::uint64_t>(i) + 1;
    const Film film = render_film(*scene, config);
    const Image radiance = film.radiance(), variance = film.variance();
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      pixels[p].add(radiance.pixels[p].g);
      claimed.add(variance.pixels[p].g);
    }
  }
  Running observed;
  for (const Running& pixel : pixels) observed.add(pixel.variance());
  std::printf("  observed / stated variance %.3f +- %.3f\n", observed.mean() / claimed.mean(),
              observed.standard_error() / claimed.mean());
  EXPECT_LT(observed.mean() + 4 * observed.standard_error(), claimed.mean());
}

}  // namespace
}  // namespace octolux::test
