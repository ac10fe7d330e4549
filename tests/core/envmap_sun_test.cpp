// A sun in an environment map: what is taken out, what is left, and which lights are narrow.
#include "core/envmap_sun.h"

#include <gtest/gtest.h>

#include "core/light.h"
#include "tests/stats.h"

namespace octolux {
namespace {

/// A sky of 512 x 257 texels, bluer and brighter towards the top.
Image sky() {
  Image map(512, 257);
  for (int y = 0; y < map.height; ++y) {
    const float up = 1 - static_cast<float>(y) / 256;
    for (int x = 0; x < map.width; ++x) map.at(x, y) = {0.3f * up, 0.5f * up, 0.2f + 0.8f * up};
  }
  return map;
}

/// Adds a disc of light around a texel.
Image with_disc(Image map, int cx, int cy, int radius, Rgb light) {
  for (int y = cy - radius; y <= cy + radius; ++y) {
    for (int x = cx - radius; x <= cx + radius; ++x) {
      const int dx = x - cx, dy = y - cy;
      if (dx * dx + dy * dy <= radius * radius) map.at((x + map.width) % map.width, y) += light;
    }
  }
  return map;
}

TEST(TakeOutSun, BothTogetherAreTheMapAsItWas) {
  const Image before = with_disc(sky(), 0, 90, 1, {60'000, 50'000, 40'000});  // across the seam
  Image rest = before;
  const std::optional<Image> sun = take_out_sun(rest);
  ASSERT_TRUE(sun);
  int taken = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float was = before.pixels[i][c], left = rest.pixels[i][c], out = sun->pixels[i][c];
      EXPECT_GE(left, 0);
      EXPECT_GE(out, 0);
      EXPECT_NEAR(left + out, was, 0x1p-22f * was);
    }
    taken += !is_black(sun->pixels[i]);
  }
  EXPECT_EQ(taken, 5);
  EXPECT_LT(max_component(rest.at(0, 90)), 0.01f * max_component(before.at(0, 90)));
}

TEST(TakeOutSun, OnlyTheSunIsNarrow) {
  Image rest = with_disc(sky(), 100, 90, 1, Rgb(50'000));
  std::optional<Image> sun = take_out_sun(rest);
  ASSERT_TRUE(sun);
  EXPECT_TRUE(make_envmap_light(std::move(*sun), {}, 1)->narrow());
  EXPECT_FALSE(make_envmap_light(std::move(rest), {}, 1)->narrow());
  EXPECT_TRUE(make_directional_light({0, -1, 0}, Rgb(1))->narrow());
  EXPECT_FALSE(make_point_light({0, 0, 0}, Rgb(1))->narrow());
  EXPECT_FALSE(make_constant_light(Rgb(1))->narrow());
}

TEST(TakeOutSun, LeavesWhatIsNoSunInASky) {
  const Image black(512, 257);
  const std::pair<const char*, Image> maps[] = {
      {"a sky without", sky()},
      {"nothing", black},
      {"a wide one, 25 degrees across", with_disc(sky(), 100, 90, 18, Rgb(50'000))},
      {"a faint one, of a hundredth of the light", with_disc(sky(), 100, 90, 1, Rgb(60))},
      {"a sun alone, narrow as it is", with_disc(black, 100, 90, 1, Rgb(50'000))},
      {"a single texel", Image(1, 1)}};
  for (const auto& [name, map] : maps) {
    Image left = map;
    EXPECT_FALSE(take_out_sun(left)) << name;
    EXPECT_TRUE(left.pixels == map.pixels) << name;
  }
  EXPECT_TRUE(make_envmap_light(maps[4].second, {}, 1)->narrow());
}

TEST(TakeOutSun, WhatIsNoNumberStaysWhereItIs) {
  Image map = with_disc(sky(), 100, 90, 1, Rgb(50'000));
  map.at(7, 20) = Rgb(std::numeric_limits<float>::infinity());
  map.at(8, 20) = {1, -3, 1e9f};
  map.at(9, 20) = Rgb(std::nanf(""));
  const std::optional<Image> sun = take_out_sun(map);
  ASSERT_TRUE(sun);
  for (const int x : {7, 8, 9}) EXPECT_TRUE(is_black(sun->at(x, 20))) << x;
  EXPECT_EQ(map.at(8, 20), (Rgb{1, -3, 1e9f}));
}

/// A cell above the equator is (2 pi / width) (pi / rows) wide and high; a texel lights four.
TEST(LitSolidAngle, IsThatOfTheCellsAroundATexel) {
  Image map(256, 129);
  EXPECT_EQ(lit_solid_angle(map), 0);
  map.at(255, 64) = {0, 0, 1};
  const double cell = 2 * std::numbers::pi / 256 * std::sin(std::numbers::pi / 128);
  EXPECT_NEAR(lit_solid_angle(map), 4 * cell, 1e-9);
  for (Rgb& c : map.pixels) c = Rgb(1);
  EXPECT_NEAR(lit_solid_angle(map), 4 * std::numbers::pi, 1e-9);
}

}  // namespace
}  // namespace octolux
