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
                    sensor_xml("0, 1, 0.01", "0, 0, 0", 20, size, size) + closed_room_xml(0.5) + R"(
    <shape type='rectangle'>
      <transform name='to_world'><rotate x='1' angle='90'/><translate y='2' x='0.5'/></transform>
      <emitter type='area'><rgb name='radiance' value='1'/></emitter></shape></scene>)");
}

TEST(PixelSequences, PassesErrLessTogetherThanIndependentOnesWould) {
  const std::vector<Film> films = render_seeds(*even_floor(12), photon_config(16, 5'000), 8);
  Running claimed, observed;
  for (const Film& film : films) {
    for (const Rgb& variance : film.variance().pixels) claimed.add(variance.g);
  }
  for (const Running& pixel : each_pixel(films)) observed.add(pixel.variance());
  std::printf("  observed / stated variance %.3f +- %.3f\n", observed.mean() / claimed.mean(),
              observed.standard_error() / claimed.mean());
  EXPECT_LT(observed.mean() + 4 * observed.standard_error(), claimed.mean());
}

}  // namespace
}  // namespace octolux::test
