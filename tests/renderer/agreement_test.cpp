// Photon mapping and the path tracer share no transport code: where both agree within their noise,
// both are right. Per pixel (z-test with the passes' variances) and in the mean.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

struct Case {
  const char* scene;
  std::map<std::string, std::string> defines;
  int width, height;
  int path_passes, photon_passes;
  std::int64_t photons;  // per pass and map
};

class AgreementSlow : public testing::TestWithParam<Case> {};

TEST_P(AgreementSlow, PerPixelAndInTheMean) {
  const Case& c = GetParam();
  const auto scene = shipped_scene(c.scene, c.defines);
  // Every pass puts its samples at the same place of all pixels: along the edge of a lamp, or of
  // the dark outside, that is one common quadrature error, which no pixel's variance knows of. So
  // lamps and the outside are not looked at.
  scene->hide_emitters = true;
  scene->camera_config.fov_x_degrees *= 0.8f;
  resize_film(*scene, c.width, c.height);
  const Film path = render_film(*scene, path_config(c.path_passes));
  const Film photon = render_film(*scene, photon_config(c.photon_passes, c.photons));
  const MeanRadiance a = mean_radiance(path), b = mean_radiance(photon);
  const PixelTest test = pixel_z_test(path, photon, 0.01);
  std::printf("  %s: mean ratio %.4f +- %.4f, chi2/dof %.3f, %d of %zu beyond Sidak\n", c.scene,
              b.mean / a.mean, a.standard_error / a.mean, test.chi2_over_dof(), test.failed,
              test.z.size());
  EXPECT_NEAR(b.mean / a.mean, 1, 0.005);
  // Mitsuba's acceptance: 99.75 % of the pixels within Sidak's limit at 0.01.
  EXPECT_LE(test.failed, static_cast<int>(0.0025 * static_cast<double>(test.z.size())));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, AgreementSlow,
    // The glass sphere is lit by a large lamp: the path tracer finds a small lamp's caustic so
    // rarely that its pixels' variance says nothing. In the dark room few gather rays find the
    // doorway: passes must be many for their mean to be near normal.
    testing::Values(
        Case{"cornell/cornell.xml", {}, 32, 32, 4096, 64, 200'000},
        Case{"glass-sphere/glass-sphere.xml", {{"lamp", "1.2"}}, 32, 24, 8192, 64, 400'000},
        Case{"two-rooms/two-rooms.xml", {}, 48, 32, 16384, 256, 200'000}),
    [](const testing::TestParamInfo<Case>& param) { return scene_name(param.param.scene); });

/// Of the pictures' means, photon mapping's over path tracing's.
struct MeanRatio {
  double value, sigma;
};

MeanRatio mean_ratio(const Scene& scene, int path_passes, const RenderConfig& photon_mapping) {
  const Running path = pass_means(scene, path_config(path_passes));
  const Running photon = pass_means(scene, photon_mapping);
  const double sigma = std::sqrt(path.variance_of_mean() + photon.variance_of_mean());
  const MeanRatio ratio{photon.mean() / path.mean(), sigma / path.mean()};
  std::printf("  photon / path %.4f +- %.4f\n", ratio.value, ratio.sigma);
  return ratio;
}

/// A small and a large lamp mirrored in a plate that is not quite smooth: the one is found by its
/// light samples, the other by the plate's lobe, and their shares must add up to one.
TEST(Agreement, LampsInAGlossyPlate) {
  const auto lamp = [](const char* size, const char* place) {
    return std::string("<shape type='rectangle'><transform name='to_world'><scale value='") + size +
           "'/><rotate y='1' angle='180'/><translate " + place +
           "/></transform><emitter type='area'><rgb name='radiance' value='1'/></emitter></shape>";
  };
  const auto scene = scene_from(
      "<scene version='3.0.0'>" + sensor_xml("0, 0, 1", "0, 0, 0", 60, 16, 16) +
      "<shape type='rectangle'><bsdf type='roughconductor'><string name='material' value='none'/>"
      "<float name='alpha' value='0.15'/></bsdf></shape>" +
      lamp("0.1", "x='-0.5' z='2'") + lamp("0.6", "x='0.7' z='2'") + "</scene>");
  const MeanRatio ratio = mean_ratio(*scene, 1024, photon_config(256, 1'000));
  EXPECT_LT(ratio.sigma, 0.005);
  EXPECT_GT(z_test_p((ratio.value - 1) / ratio.sigma), kAlpha);
}

/// A white plate under an even sky, mirrored in one that is not quite smooth: samples with a gather
/// and those of direct light alone must share out the sky alike.
TEST(Agreement, SkylightBehindAGlossyPlate) {
  const auto scene = scene_from(
      "<scene version='3.0.0'>" + sensor_xml("0, 0, 1", "0, 0, 0", 60, 16, 16) +
      "<shape type='rectangle'><bsdf type='roughconductor'><string name='material' value='none'/>"
      "<float name='alpha' value='0.15'/></bsdf></shape><shape type='rectangle'><transform "
      "name='to_world'><scale value='4'/><rotate y='1' angle='180'/><translate z='4'/></transform>"
      "</shape><emitter type='constant'/></scene>");
  RenderConfig config = photon_config(128, 5'000);
  config.eye.light_samples = 1;
  config.eye.direct_samples = 3;
  const MeanRatio ratio = mean_ratio(*scene, 2048, config);
  EXPECT_LT(ratio.sigma, 0.0015);
  EXPECT_NEAR(ratio.value, 1, 0.002 + 3 * ratio.sigma);  // the map's own bias, and noise
}

/// Varnished walls and a metal floor: what either shows is followed by chance or on several paths,
/// and must weigh as much as if one path had followed it always.
TEST(Agreement, RoomOfMetalAndVarnish) {
  const auto scene = scene_from(
      "<scene version='3.0.0'>" + sensor_xml("0, 1.5, -1.9", "0, 1, 0", 80, 12, 12) +
      "<bsdf type='twosided' id='varnish'><bsdf type='roughplastic'><float name='alpha' "
      "value='0.1'/><rgb name='diffuse_reflectance' value='0.4'/></bsdf></bsdf>"
      "<bsdf type='roughconductor' id='metal'><float name='alpha' value='0.15'/></bsdf>"
      "<shape type='cube'><transform name='to_world'><scale value='2'/><translate y='2'/>"
      "</transform><ref id='varnish'/></shape>"
      "<shape type='rectangle'><transform name='to_world'><scale value='1.9'/><rotate x='1' "
      "angle='-90'/><translate y='0.05'/></transform><ref id='metal'/></shape>"
      "<shape type='rectangle'><transform name='to_world'><scale value='0.7'/><rotate x='1' "
      "angle='90'/><translate y='3.9'/></transform><emitter type='area'><rgb name='radiance' "
      "value='1'/></emitter></shape></scene>");
  const MeanRatio ratio = mean_ratio(*scene, 4096, photon_config(48, 5'000));
  EXPECT_LT(ratio.sigma, 0.002);
  EXPECT_NEAR(ratio.value, 1, 0.003 + 3 * ratio.sigma);  // the map's own bias, and noise
}

}  // namespace
}  // namespace octolux::test
