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

/// A lamp seen in glass that is dark behind: each eye path sees it with the chance of reflection.
std::unique_ptr<Scene> lamp_in_glass(int size) {
  return scene_from("<scene version='3.0.0'>" + sensor_xml("0, 0, 1", "0, 0, 0", 20, size, size) +
                    R"(
    <shape type='rectangle'><bsdf type='dielectric'><float name='int_ior' value='2.5'/></bsdf></shape>
    <shape type='rectangle'>
      <transform name='to_world'><rotate y='1' angle='180'/><translate z='2'/></transform>
      <emitter type='area'><rgb name='radiance' value='1'/></emitter></shape></scene>)");
}

/// The edge of a lamp, far out of focus: every pixel sees it through half of the lens.
std::unique_ptr<Scene> lamp_out_of_focus(int size) {
  const std::string pixels = std::to_string(size);
  return scene_from(R"(<scene version='3.0.0'>
    <sensor type='thinlens'>
      <float name='fov' value='0.01'/><float name='near_clip' value='0.0001'/>
      <float name='aperture_radius' value='0.5'/><float name='focus_distance' value='1000'/>
      <transform name='to_world'><lookat origin='0, 0, 1' target='0, 0, 0' up='0, 1, 0'/></transform>
      <film type='hdrfilm'><integer name='width' value=')" +
                    pixels + "'/><integer name='height' value='" + pixels + R"('/>
        <rfilter type='box'/></film></sensor>
    <shape type='rectangle'><transform name='to_world'><translate x='1'/></transform>
      <emitter type='area'><rgb name='radiance' value='1'/></emitter></shape></scene>)");
}

/// Variance between pictures by different seeds, and what they state.
struct Variances {
  Running observed, stated;
};
Variances variances(const Scene& scene, int direct_samples = 0) {
  RenderConfig config = photon_config(16, 5'000);
  config.eye.direct_samples = direct_samples;
  const std::vector<Film> films = render_seeds(scene, config, 8);
  Variances v;
  for (const Film& film : films) {
    for (const Rgb& variance : film.variance().pixels) v.stated.add(variance.g);
  }
  for (const Running& pixel : each_pixel(films)) v.observed.add(pixel.variance());
  std::printf("  observed / stated variance %.3f +- %.3f\n", v.observed.mean() / v.stated.mean(),
              v.observed.standard_error() / v.stated.mean());
  return v;
}

TEST(PixelSequences, PassesErrLessTogetherThanIndependentOnesWould) {
  const Variances v = variances(*even_floor(12));
  EXPECT_LT(v.observed.mean() + 4 * v.observed.standard_error(), v.stated.mean());
}

/// Of 16 samples in sequence as many as should be, or one more or less, are reflected.
TEST(PixelSequences, ReflectionIsSeenAsOftenAsItShould) {
  for (const int direct_samples : {0, 3}) {
    const Variances v = variances(*lamp_in_glass(12), direct_samples);
    EXPECT_GT(v.stated.mean(), 0);
    EXPECT_LT(v.observed.mean() + 4 * v.observed.standard_error(), 0.25 * v.stated.mean());
  }
}

TEST(PixelSequences, LensIsSeenThroughEvenly) {
  const Variances v = variances(*lamp_out_of_focus(12));
  EXPECT_GT(v.stated.mean(), 0);
  EXPECT_LT(v.observed.mean() + 4 * v.observed.standard_error(), 0.25 * v.stated.mean());
}

}  // namespace
}  // namespace octolux::test
