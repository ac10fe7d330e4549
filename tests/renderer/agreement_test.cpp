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

}  // namespace
}  // namespace octolux::test
