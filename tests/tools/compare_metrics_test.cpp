// The measures of `octolux compare` against closed forms and plain loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "tests/core/error_testing.h"
#include "tests/tools/pictures.h"
#include "tools/compare/metrics.h"

namespace octolux {
namespace {

using test::constant;
using test::picture;
using test::random_image;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Metrics measure(const Image& reference, const Image& image, const Mask& mask = {}) {
  const NamedPicture y = picture("y", reference), x = picture("x", image);
  return measure_error(view_layer(y), view_layer(x), mask);
}

TEST(CompareMetrics, EqualPicturesHaveNoError) {
  const Image image = random_image(64, 48, 1);
  const Metrics m = measure(image, image);
  EXPECT_EQ(m.pixels, 64 * 48);
  for (const double zero :
       {m.mse, m.rmse, m.mae, m.rel_mse, m.trimmed_rel_mse, m.mrse, m.smape, m.light_leak}) {
    EXPECT_EQ(zero, 0);
  }
  EXPECT_EQ(m.psnr, kInf);
  EXPECT_EQ(m.mean_ratio, 1);
  EXPECT_FALSE(m.noise.has_value());
}

/// Every figure by hand: y = 0.5, x = 0.75 in half of the pixels and 0.25 in the others.
TEST(CompareMetrics, ConstantDifferencesHaveClosedForms) {
  const Image y = constant(10, 10, Rgb(0.5f));
  const Image x = test::paint(10, 10, [](int, int row) { return Rgb(row < 5 ? 0.75f : 0.25f); });
  const Metrics m = measure(y, x);
  EXPECT_DOUBLE_EQ(m.mse, 0.0625);
  EXPECT_DOUBLE_EQ(m.rmse, 0.25);
  EXPECT_DOUBLE_EQ(m.mae, 0.25);
  // Sums of 300 numbers of one size are off by at most 300 units of the last place.
  const double rounding = 300 * std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(m.rel_mse, 0.0625 / 0.26, rounding);
  EXPECT_NEAR(m.mrse, 0.0625 / (0.51 * 0.51), rounding);
  EXPECT_NEAR(m.smape, (0.5 / 1.26 + 0.5 / 0.76) / 2, rounding);
  EXPECT_DOUBLE_EQ(m.psnr, 10 * std::log10(16));
  EXPECT_DOUBLE_EQ(m.mean_ratio, 1);
  EXPECT_DOUBLE_EQ(m.light_leak, 0.25);  // a half of the pixels, 0.25 / 0.5
  EXPECT_DOUBLE_EQ(m.shadow_leak, 0.25);
}

TEST(CompareMetrics, PsnrLooksAtWhatADisplayCanShow) {
  EXPECT_EQ(measure(constant(4, 4, Rgb(2)), constant(4, 4, Rgb(9))).psnr, kInf);
  EXPECT_DOUBLE_EQ(measure(constant(4, 4, Rgb(1)), constant(4, 4, Rgb(-3))).psnr, 0);
}

TEST(CompareMetrics, ABlackReferenceHasNoRatio) {
  const Metrics m = measure(constant(4, 4, Rgb(0)), constant(4, 4, Rgb(0.1f)));
  EXPECT_TRUE(std::isnan(m.mean_ratio));
  EXPECT_TRUE(std::isnan(m.light_leak));
  EXPECT_NEAR(m.rel_mse, 1, 1e-6);  // 0.1f is not 0.1
}

/// relMSE over 1000 pixels of which one is a firefly: trimmed away.
TEST(CompareMetrics, TrimmingDropsTheWorstThousandth) {
  const Image y = constant(50, 40, Rgb(1));
  Image x = constant(50, 40, Rgb(1.5f));
  x.at(7, 7) = Rgb(1000);
  x.at(20, 30) = Rgb(500);
  EXPECT_DOUBLE_EQ(measure(y, x).trimmed_rel_mse, static_cast<double>(0.25f / 1.01f));
  EXPECT_GT(measure(y, x).rel_mse, 100);
}

TEST(CompareMetrics, SumWithoutLargestIsThatOfASortedList) {
  Rng rng(3, Stream::test, 0, 0);
  std::vector<float> errors(300000);
  for (float& e : errors) e = std::exp2(40 * rng.uniform() - 30);
  for (std::size_t i = 0; i < 1000; ++i) errors[i * 7] = 512;  // many equal ones
  std::vector<float> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  for (const std::int64_t dropped : {0, 1, 300, 5000, 12345, 299999, 300000}) {
    double sum = 0;
    for (std::size_t i = 0; i + static_cast<std::size_t>(dropped) < sorted.size(); ++i) {
      sum += static_cast<double>(sorted[i]);
    }
    // Two orders of summing n numbers that are not negative differ by at most 2 n eps of the sum.
    EXPECT_NEAR(sum_without_largest(errors, dropped), sum, 600000 * 1.2e-16 * sum) << dropped;
  }
}

TEST(CompareMetrics, ValuesThatAreNotFiniteAreCountedAndLeftOut) {
  const Image y = constant(20, 20, Rgb(1));
  Image x = constant(20, 20, Rgb(1.5f));
  x.at(3, 2) = {1, kNan, 1};
  x.at(4, 2) = {kInf, 1, -kInf};
  x.at(5, 2) = {kInf, kNan, 1};
  x.at(6, 2) = {-0.5f, 1.5f, 1.5f};
  const Metrics m = measure(y, x);
  EXPECT_EQ(m.image.nan, 2);
  EXPECT_EQ(m.image.infinite, 1);
  EXPECT_EQ(m.image.negative, 1);
  EXPECT_EQ(m.image.first, 2 * 20 + 3);
  EXPECT_EQ(m.reference.non_finite(), 0);
  EXPECT_EQ(m.pixels, 397);
  EXPECT_DOUBLE_EQ(m.mse, (0.25 * (397 * 3 - 1) + 2.25) / (397 * 3));
}

TEST(CompareMetrics, WithoutAnyFinitePixelNothingIsKnown) {
  const Metrics m = measure(constant(4, 4, Rgb(1)), constant(4, 4, Rgb(kNan)));
  EXPECT_EQ(m.pixels, 0);
  EXPECT_EQ(m.image.nan, 16);
  EXPECT_TRUE(std::isnan(m.rel_mse));
  EXPECT_TRUE(std::isnan(m.trimmed_rel_mse));
}

TEST(CompareMetrics, OnlyPixelsOfTheMaskCount) {
  const Image y = constant(20, 10, Rgb(1));
  const Image x = test::paint(20, 10, [](int column, int) { return Rgb(column < 5 ? 2.f : kNan); });
  const NamedPicture reference = picture("y", y);
  const Mask mask = mask_of("--rect", {0, 0, 5, 10}, view_layer(reference));
  const Metrics m = measure(y, x, mask);
  EXPECT_EQ(m.pixels, 50);
  EXPECT_EQ(m.image.nan, 0);
  EXPECT_DOUBLE_EQ(m.mse, 1);
}

/// bias^2: what is left of the error after both variances.
TEST(CompareMetrics, VarianceLayersSplitTheError) {
  const NamedPicture y =
      test::noisy_picture("y", constant(8, 8, Rgb(1)), constant(8, 8, Rgb(0.125f)), 16);
  const NamedPicture x =
      test::noisy_picture("x", constant(8, 8, Rgb(2)), constant(8, 8, Rgb(0.5f)), 16);
  const Metrics m = measure_error(view_layer(y), view_layer(x));
  ASSERT_TRUE(m.noise.has_value());
  EXPECT_DOUBLE_EQ(m.noise->variance_image, 0.5);
  EXPECT_DOUBLE_EQ(m.noise->variance_reference, 0.125);
  EXPECT_DOUBLE_EQ(m.noise->bias2, 0.375);
}

TEST(CompareMetrics, ThreadsChangeNoDigit) {
  const Image y = random_image(301, 203, 1), x = random_image(301, 203, 2, 3);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return measure(y, x);
  };
  const Metrics one = with_threads(1), seven = with_threads(7);
  EXPECT_EQ(one.rel_mse, seven.rel_mse);
  EXPECT_EQ(one.trimmed_rel_mse, seven.trimmed_rel_mse);
  EXPECT_EQ(one.smape, seven.smape);
  EXPECT_EQ(one.mean_ratio, seven.mean_ratio);
}

TEST(CompareMetrics, OtherSizesAndChannelsAreRefused) {
  const NamedPicture y = picture("y.exr", constant(4, 3, Rgb(1)));
  const NamedPicture wide = picture("wide.exr", constant(5, 3, Rgb(1)));
  test::expect_error("wide.exr", "has 5x3 pixels; expected 4x3",
                     [&] { measure_error(view_layer(y), view_layer(wide)); });
  NamedPicture depth = y;
  depth.name = "depth.exr";
  depth.file.layers = {{"", {"Z"}, {std::vector<float>(12, 1)}}};
  test::expect_error("depth.exr", "the root layer has the channels Z; expected R G B",
                     [&] { measure_error(view_layer(y), view_layer(depth)); });
  test::expect_error("y.exr", "has no channels in layer 'albedo'",
                     [&] { view_layer(y, "albedo"); });
}

TEST(CompareMetrics, ALoneYIsGreyAndAlphaIsLeftOut) {
  NamedPicture grey = picture("grey.exr", constant(4, 3, Rgb(1)));
  grey.file.layers = {{"", {"Y", "A"}, {std::vector<float>(12, 2), std::vector<float>(12, 0)}}};
  const NamedPicture y = picture("y.exr", constant(4, 3, Rgb(1)));
  EXPECT_DOUBLE_EQ(measure_error(view_layer(y), view_layer(grey)).mse, 1);
}

TEST(CompareMasks, RectanglesAreParsedOrRefused) {
  const Rectangle r = parse_rectangle("--rect", "10,20,64x48");
  EXPECT_EQ(r.x, 10);
  EXPECT_EQ(r.height, 48);
  for (const char* bad : {"", "1,2,3", "1,2,3x", "1,2,3x4 ", "-1,2,3x4", "1,2,0x4", "1;2,3x4"}) {
    EXPECT_THROW(parse_rectangle("--rect", bad), Error) << bad;
  }
  const NamedPicture y = picture("y.exr", constant(8, 8, Rgb(1)));
  EXPECT_THROW(mask_of("--rect", {5, 0, 4, 8}, view_layer(y)), Error);
  EXPECT_EQ(count_pixels(mask_of("--rect", {4, 0, 4, 8}, view_layer(y)), 64), 32);
}

TEST(CompareMasks, PicturesMaskWhereAnyChannelIsAboveZero) {
  const NamedPicture y = picture("y.exr", constant(8, 8, Rgb(1)));
  Image image(8, 8);
  image.at(1, 0) = {0, 0.1f, 0};
  image.at(2, 0) = Rgb(-1);
  image.at(3, 0) = Rgb(kNan);
  const Mask mask = mask_of(picture("mask.exr", image), view_layer(y));
  EXPECT_EQ(count_pixels(mask, 64), 1);
  EXPECT_TRUE(counts(mask, 1));
  EXPECT_THROW(mask_of(picture("black.exr", Image(8, 8)), view_layer(y)), Error);
  EXPECT_THROW(mask_of(picture("small.exr", constant(4, 8, Rgb(1))), view_layer(y)), Error);
}

}  // namespace
}  // namespace octolux
