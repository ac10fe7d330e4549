// The test of pictures against their noise: right as often as promised, and able to see.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/statistics.h"
#include "tests/tools/pictures.h"
#include "tools/compare/noise_test.h"

namespace octolux {
namespace {

constexpr int kPasses = 8;

float normal(Rng& rng) {
  const float u = rng.uniform();
  const float v = rng.uniform();
  return std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi_v<float> * v);
}

/// The mean of passes of independent normal values around `mean`, of deviation 0.5, with the
/// variance such a render would write.
NamedPicture render(const std::string& name, float mean, std::uint64_t index, int size = 64) {
  Rng rng(5, Stream::test, 0, index);
  Image image(size, size), variance(size, size);
  const auto value = [&](float& average, float& spread) {
    Running running;
    for (int pass = 0; pass < kPasses; ++pass) {
      running.add(static_cast<double>(mean + 0.5f * normal(rng)));
    }
    average = static_cast<float>(running.mean());
    spread = static_cast<float>(running.variance_of_mean());
  };
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    value(image.pixels[i].r, variance.pixels[i].r);
    value(image.pixels[i].g, variance.pixels[i].g);
    value(image.pixels[i].b, variance.pixels[i].b);
  }
  return test::noisy_picture(name, image, variance, kPasses);
}

/// At alpha = 0.5, 40 pairs of pictures that differ by noise alone are told apart 20 times; the
/// binomial's deviation is 3.2, and beyond four of them lies 6e-5. A z-test would reject them all.
TEST(CompareNoise, FalseAlarmsComeAsOftenAsPromised) {
  int alarms = 0;
  for (std::uint64_t pair = 0; pair < 40; ++pair) {
    const NamedPicture a = render("a", 1, 2 * pair, 16), b = render("b", 1, 2 * pair + 1, 16);
    alarms += test_noise(view_layer(a), view_layer(b), {}, 0.5).differ();
  }
  EXPECT_NEAR(alarms, 20, 4 * 3.2);
}

TEST(CompareNoise, ADifferentPixelIsFoundAndNamed) {
  const NamedPicture a = render("a", 1, 100);
  NamedPicture b = render("b", 1, 101);
  b.file.layers[0].planes[1][5 * 64 + 9] += 25;
  const NoiseTest test = test_noise(view_layer(a), view_layer(b));
  EXPECT_EQ(test.tested, 64 * 64 * 3);
  EXPECT_TRUE(test.differ());
  EXPECT_EQ(test.rejected, 1);
  EXPECT_EQ(test.largest_at, 5 * 64 + 9);
  EXPECT_GT(test.largest, 20);
  EXPECT_LT(test.smallest_p, test.sidak_alpha);
  EXPECT_EQ(test.sidak_alpha, sidak(kNoiseAlpha, 64 * 64 * 3));
  const NamedPicture c = render("c", 1, 102);
  EXPECT_FALSE(test_noise(view_layer(a), view_layer(c)).differ());
}

/// Without the number of passes the variances are exact: a plain z-test, checked by hand.
TEST(CompareNoise, ExactVariancesMakeAZTest) {
  NamedPicture a =
      test::noisy_picture("a", test::constant(2, 1, Rgb(1)), test::constant(2, 1, Rgb(0.25f)), 2);
  a.file.attributes.number.clear();
  NamedPicture b = test::picture("b", test::constant(2, 1, Rgb(1)));
  b.file.layers[0].planes[0] = {1, 4};
  const NoiseTest test = test_noise(view_layer(a), view_layer(b));
  EXPECT_EQ(test.tested, 6);
  EXPECT_EQ(test.largest, 6);
  EXPECT_EQ(test.largest_at, 1);
  EXPECT_DOUBLE_EQ(test.smallest_p, z_test_p(6));
  EXPECT_TRUE(test.differ());
}

/// The mask and pixels without a variance are left out, the latter counted where they differ.
TEST(CompareNoise, WhatCannotBeTestedIsCounted) {
  const Image variance = test::paint(4, 1, [](int x, int) { return Rgb(x < 2 ? 0.f : 1.f); });
  const NamedPicture a = test::noisy_picture("a", test::constant(4, 1, Rgb(1)), variance, kPasses);
  NamedPicture b = test::picture("b", test::constant(4, 1, Rgb(1)));
  b.file.layers[0].planes[0] = {9, 1, 1, 1};
  const NoiseTest test = test_noise(view_layer(a), view_layer(b));
  EXPECT_EQ(test.tested, 6);
  EXPECT_EQ(test.untested, 1);
  EXPECT_FALSE(test.differ());
  EXPECT_EQ(test_noise(view_layer(a), view_layer(b), {0, 0, 0, 1}).tested, 3);
}

TEST(CompareNoise, OnePassHasNoSpread) {
  const NamedPicture a =
      test::noisy_picture("a", test::constant(4, 1, Rgb(1)), test::constant(4, 1, Rgb(0)), 1);
  EXPECT_TRUE(view_layer(a).variance.empty());
}

}  // namespace
}  // namespace octolux
