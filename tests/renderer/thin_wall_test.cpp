// Light behind a thin wall, from the scene file to the film: in scenes/thin-wall no light reaches
// the right room, and with the kernels that look at the geometry no pixel of it differs from black
// by a single bit, whether the map is shown directly or gathered, and whether gather rays share
// look-ups or not. The other kernels do leak there, or the test would show nothing, unless gathered
// look-ups count only what they see.
#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// The part of the picture right of the partition: the dark room and what is outside.
std::unique_ptr<Scene> dark_room(const char* thickness, int width) {
  auto scene = shipped_scene("thin-wall/thin-wall.xml", {{"wall", thickness}});
  const int height = width * 9 / 16, left = width * 15 / 32;
  scene->film = {width, height, left, 0, width - left, height};
  scene->camera = Camera(scene->camera_config, scene->film);
  return scene;
}

/// Bandwidths of some 20 cm, in every pass.
RenderConfig wide_look_ups(const char* kernel, bool gather, double reuse, int passes, bool seen) {
  RenderConfig config = photon_config(passes, 10'000);
  config.photons.alpha = 1;
  config.estimator.kernel = kernel;
  config.estimator.neighbours = 100;
  config.eye.gather = gather;
  config.eye.reuse = reuse;
  config.eye.seen = seen;
  return config;
}

int lit_pixels(const Scene& scene, const RenderConfig& config) {
  const Image radiance = render_film(scene, config).radiance();
  return static_cast<int>(std::count_if(radiance.pixels.begin(), radiance.pixels.end(),
                                        [](Rgb c) { return c.r != 0 || c.g != 0 || c.b != 0; }));
}

struct Mode {
  const char* name;
  bool gather;
  double reuse;
};
constexpr Mode kModes[] = {
    {"Direct", false, 0}, {"Gathered", true, 0}, {"Shared", true, EyeConfig{}.reuse}};

class ThinWall : public testing::TestWithParam<Mode> {
 protected:
  /// Lit pixels over all thicknesses of the wall.
  int lit(const char* kernel, int width, int passes) const {
    int count = 0;
    for (const char* thickness : {"0.1", "0.02", "0.001"}) {
      const auto room = dark_room(thickness, width);
      const Mode& mode = GetParam();
      count += lit_pixels(*room, wide_look_ups(kernel, mode.gather, mode.reuse, passes, false));
    }
    return count;
  }
};
using ThinWallSlow = ThinWall;

TEST_P(ThinWall, IsBlackToTheLastBitWithFeelers) {
  EXPECT_EQ(lit("feeler", 64, 1), 0);
  EXPECT_EQ(lit("region", 64, 1), 0);
}

TEST_P(ThinWall, LeaksWithoutFeelers) {
  for (const char* kernel : {"cone", "octobox"}) EXPECT_GT(lit(kernel, 64, 1), 0) << kernel;
}

TEST(ThinWallSeen, IsBlackToTheLastBitWithEveryKernel) {
  for (const char* thickness : {"0.1", "0.02", "0.001"}) {
    const auto room = dark_room(thickness, 64);
    for (const std::string& kernel : kernel_names()) {
      for (const double reuse : {0.0, EyeConfig{}.reuse}) {
        const RenderConfig config = wide_look_ups(kernel.c_str(), true, reuse, 1, true);
        EXPECT_EQ(lit_pixels(*room, config), 0) << kernel << ", reuse " << reuse;
      }
    }
  }
}

// A million looks at the map by each kernel, from the eye or by eight gather rays for each sample.
TEST_P(ThinWallSlow, IsBlackToTheLastBitWithFeelers) {
  const int passes = GetParam().gather ? 3 : 18;
  for (const char* kernel : {"feeler", "region"}) EXPECT_EQ(lit(kernel, 256, passes), 0) << kernel;
}

// The partition ends 5 cm in front of the floor: of feelers no longer than the look-up may reach
// some passed beside it, and none met it.
TEST(ThinWallShortLookUpsSlow, AreBlackToTheLastBit) {
  for (const char* thickness : {"0.02", "0.001"}) {
    RenderConfig config = wide_look_ups("feeler", true, 0, 3, false);
    config.photons.global_radius = 2;
    EXPECT_EQ(lit_pixels(*dark_room(thickness, 256), config), 0) << thickness;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, ThinWall, testing::ValuesIn(kModes),
                         [](const testing::TestParamInfo<Mode>& param) {
                           return param.param.name;
                         });
INSTANTIATE_TEST_SUITE_P(Modes, ThinWallSlow, testing::ValuesIn(kModes),
                         [](const testing::TestParamInfo<Mode>& param) {
                           return param.param.name;
                         });

}  // namespace
}  // namespace octolux::test
