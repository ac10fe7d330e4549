// renderer/config.h, stop_rules.h: what automatic settings stand for, and how many passes that
// makes.
#include "renderer/config.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "renderer/stop_rules.h"

namespace octolux {
namespace {

int eye_samples(std::int64_t pixels, const RenderConfig& config = {}) {
  return resolved(config, pixels).eye.samples_per_pass;
}

TEST(AutomaticSettings, PhotonsAreHalfThePixels) {
  EXPECT_EQ(resolved({}, 1'000'000).photons.global, 500'000);
  EXPECT_EQ(resolved({}, 100).photons.global, 50'000);
}

TEST(AutomaticSettings, EyeSamplesAreThreeAPhotonButFourAPixelAtMost) {
  EXPECT_EQ(eye_samples(512 * 512), 1);
  EXPECT_EQ(eye_samples(256 * 256), 2);
  EXPECT_EQ(eye_samples(240 * 160), 3);
  EXPECT_EQ(eye_samples(128 * 96), 4);
  EXPECT_EQ(eye_samples(1), 4);
  RenderConfig config;
  config.photons.global = 1000;
  EXPECT_EQ(eye_samples(128 * 96, config), 1);
  config.photons.global = 0;
  EXPECT_EQ(eye_samples(128 * 96, config), 1);
}

TEST(AutomaticSettings, PathTracingTakesOneSampleAPass) {
  RenderConfig config;
  config.integrator = Integrator::path;
  EXPECT_EQ(eye_samples(100, config), 1);
}

TEST(AutomaticSettings, WhatIsSetStays) {
  RenderConfig config;
  config.photons.global = 7;
  config.photons.caustic = 0;
  config.eye.samples_per_pass = 9;
  const RenderConfig same = resolved(config, 100);
  EXPECT_EQ(same.photons.global, 7);
  EXPECT_EQ(same.photons.caustic, 0);
  EXPECT_EQ(same.eye.samples_per_pass, 9);
}

TEST(AutomaticSettings, WholePassesTakeExactlyTheSamplesAskedFor) {
  for (int samples = 1; samples <= 40; ++samples) {
    RenderConfig config;
    config.stop.samples = samples;
    config = resolved(config, 100);
    EXPECT_EQ(pass_limit(config) * config.eye.samples_per_pass, samples);
  }
}

TEST(AutomaticSettings, OnlyMinusOneStandsForThem) {
  RenderConfig config;
  EXPECT_NO_THROW(check(config));
  for (const int bad : {0, -2}) {
    config.eye.samples_per_pass = bad;
    EXPECT_THROW(check(config), Error) << bad;
  }
  config = {};
  config.eye.direct_samples = 0;
  EXPECT_NO_THROW(check(config));
  config.eye.direct_samples = -2;
  EXPECT_THROW(check(config), Error);
}

}  // namespace
}  // namespace octolux
