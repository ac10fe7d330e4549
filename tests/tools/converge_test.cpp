// Error against time: numbers against pictures whose error is known, slopes of curves that are
// straight, who is named the fastest, and the text forms of it all.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/rng.h"
#include "tests/temporary_folder.h"
#include "tests/tools/pictures.h"
#include "tools/converge/external.h"
#include "tools/converge/study.h"
#include "tools/converge/variant.h"

namespace octolux {
namespace {

constexpr float kTruth = 0.5f;
constexpr double kWeight = 1 / (0.25 + 0.01);  // of relMSE at that truth

/// 0.5 + bias, with uniform noise of a standard deviation.
Image noisy(double bias, double deviation, std::uint64_t seed) {
  Rng rng(5, Stream::test, 0, seed);
  const auto half = static_cast<float>(std::sqrt(3.0) * deviation);
  return test::paint(64, 64, [&](int, int) {
    const float r = rng.uniform(), g = rng.uniform(), b = rng.uniform();
    const float base = kTruth + static_cast<float>(bias) - half;
    return Rgb(base + 2 * half * r, base + 2 * half * g, base + 2 * half * b);
  });
}

class ConvergeTest : public ::testing::Test {
 protected:
  std::vector<TimedPicture> write(double bias, double deviation, int seeds) {
    std::vector<TimedPicture> pictures;
    for (int s = 0; s < seeds; ++s) {
      const std::string path = folder_ / ("x" + std::to_string(s) + ".exr");
      const Image image = noisy(bias, deviation, static_cast<std::uint64_t>(s));
      write_exr(path, test::picture(path, image).file);
      pictures.push_back({path, 2.0 + s, 4});
    }
    return pictures;
  }
  test::TemporaryFolder folder_;
  NamedPicture truth_ = test::picture("truth", test::constant(64, 64, Rgb(kTruth)));
};

TEST_F(ConvergeTest, TellsBiasFromNoise) {
  const SeriesPoint p = measure_point(truth_, write(0.02, 0.1, 6));
  EXPECT_EQ(p.passes, 4);
  EXPECT_DOUBLE_EQ(p.seconds, 4.5);
  ASSERT_TRUE(p.noise2 && p.bias2 && p.bias2_error);
  // Of n = 6 * 12288 values: sd(s^2) = s^2 sqrt(0.8 / n) for uniform noise, times 5 for certainty.
  const double values = 6 * 64 * 64 * 3;
  EXPECT_NEAR(*p.noise2, kWeight * 0.01, 5 * kWeight * 0.01 * std::sqrt(1.0 / values));
  EXPECT_NEAR(*p.bias2, kWeight * 4e-4, 5 * kWeight * 2 * 0.02 * 0.1 / std::sqrt(values));
  EXPECT_GT(*p.bias2_error, 0);
  EXPECT_NEAR(p.error() * p.error(), *p.noise2 + *p.bias2, 1e-12);
}

TEST_F(ConvergeTest, UnbiasedPicturesHaveNoBias) {
  const SeriesPoint p = measure_point(truth_, write(0, 0.1, 8));
  EXPECT_LT(std::abs(*p.bias2), 5 * *p.bias2_error);
}

TEST_F(ConvergeTest, TheReferencesNoiseIsNoError) {
  const Image reference = noisy(0, 0.05, 99);
  const NamedPicture noisy_truth =
      test::noisy_picture("truth", reference, test::constant(64, 64, Rgb(0.0025f)), 1000);
  const SeriesPoint p = measure_point(noisy_truth, write(0, 0.1, 4));
  EXPECT_GT(p.floor, 0);
  EXPECT_LT(std::abs(*p.bias2), 0.1 * p.floor);
}

TEST_F(ConvergeTest, OnePictureIsSplitByItsOwnVariance) {
  const std::string path = folder_ / "own.exr";
  write_exr(
      path,
      test::noisy_picture(path, noisy(0, 0.1, 3), test::constant(64, 64, Rgb(0.01f)), 4).file);
  const SeriesPoint own = measure_point(truth_, {{path, 1, 4}});
  ASSERT_TRUE(own.noise2);
  EXPECT_NEAR(*own.noise2, kWeight * 0.01, 1e-6);
  EXPECT_TRUE(std::isnan(own.rel_mse_error));
  const SeriesPoint none = measure_point(truth_, {write(0, 0.1, 1).front()});
  EXPECT_FALSE(none.noise2 || none.bias2);
}

/// error = scale * time^slope, with `spread` between three seeds, up or down.
Series straight(const std::string& name, double scale, double slope, double spread = 0.02) {
  Series series{name, false, {}};
  for (const double t : {1.0, 2.0, 4.0, 8.0}) {
    SeriesPoint p;
    p.passes = static_cast<int>(t);
    p.seconds = t;
    for (const double factor : {1 - spread, 1.0, 1 + spread}) {
      const double error = scale * factor * std::pow(t, slope);
      p.seeds.push_back({"", t, error * error, error * error, 1});
      p.rel_mse += error * error / 3;
    }
    series.points.push_back(p);
  }
  return series;
}

TEST(ConvergeFit, FindsTheSlope) {
  const std::optional<Slope> slope = fit_slope(straight("a", 0.2, -0.5));
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->value, -0.5, 1e-9);
  EXPECT_NEAR(slope->standard_error, 0, 1e-9);
  EXPECT_EQ(slope->points, 4);
  Series two = straight("b", 0.2, -0.5);
  two.points.resize(2);
  EXPECT_FALSE(fit_slope(two));
}

TEST(ConvergeFit, TimesToTargets) {
  const Series series = straight("a", 0.2, -0.5, 0);
  const TimeToTarget reached = time_to(series, 0.1);
  EXPECT_EQ(reached.kind, TimeToTarget::Kind::reached);
  EXPECT_NEAR(reached.seconds, 4, 1e-9);
  const TimeToTarget later = time_to(series, 0.02);
  EXPECT_EQ(later.kind, TimeToTarget::Kind::foreseen);
  EXPECT_NEAR(later.seconds, 100, 1e-6);
  EXPECT_EQ(time_to(series, 0.3).kind, TimeToTarget::Kind::at_once);
  EXPECT_EQ(time_to(straight("b", 0.2, 0), 0.1).kind, TimeToTarget::Kind::never);
}

TEST(ConvergeFit, NamesTheFastestAndWhoIsLevel) {
  const std::vector<Series> all = {straight("slow", 0.3, -0.5), straight("fast", 0.2, -0.5),
                                   straight("level", 0.2005, -0.5)};
  const Winner winner = find_winner(all, 0.1);
  EXPECT_EQ(winner.series, 1);
  EXPECT_EQ(winner.level_with, std::vector<int>{2});
  EXPECT_EQ(to_text(winner, all), "to 10 % error: fast, 4 s; level with it: level");
  EXPECT_TRUE(find_winner(all, 0.01).foreseen);
}

TEST(ConvergeStudy, CsvAndJsonAndPlotHaveEveryPoint) {
  Study study;
  study.scene = "a<b>.xml";
  study.series = {straight("one", 0.2, -0.5), straight("two \"x\"", 0.4, -0.4)};
  study.seeds = 3;
  study.time_unit = "seconds";
  conclude(study);
  const std::string csv = to_csv(study);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 4 * 4);
  EXPECT_NE(csv.find("\"two \"\"x\"\"\","), std::string::npos);
  const nlohmann::ordered_json json = to_json(study);
  EXPECT_EQ(json["series"].size(), 2u);
  EXPECT_EQ(json["series"][1]["points"].size(), 4u);
  EXPECT_NEAR(json["series"][0]["slope"]["value"].get<double>(), -0.5, 1e-9);
  EXPECT_EQ(json["targets"].size(), 3u);
  EXPECT_NE(to_svg(draw(study)).find("a&lt;b&gt;.xml"), std::string::npos);
  const std::string page = make_page(study, "pictures.html");
  EXPECT_EQ(page.find("a<b>"), std::string::npos);
  EXPECT_NE(page.find("href=\"pictures.html\""), std::string::npos);
}

TEST(ConvergeVariants, AreTheProductOfTheChoices) {
  VariantChoices choices;
  choices.kernels = {"cone:published", "octobox"};
  choices.photons = {1000, 2000};
  choices.gathers = {"on", "off"};
  const std::vector<Variant> variants = make_variants(choices, {});
  ASSERT_EQ(variants.size(), 9u);
  EXPECT_EQ(variants.front().name, "cone:published, 1000 photons, gather on");
  EXPECT_FALSE(variants.front().config.estimator.correction);
  EXPECT_EQ(variants[3].config.photons.global, 2000);
  EXPECT_EQ(variants.back().name, "path");
  choices.integrators = {"bdpt"};
  EXPECT_THROW(make_variants(choices, {}), Error);
}

TEST(ConvergeExternal, ReadsPoints) {
  const External external = parse_external("pbrt=8:b.exr,4:a.exr,8:c.exr");
  EXPECT_EQ(external.name, "pbrt");
  ASSERT_EQ(external.points.size(), 2u);
  EXPECT_EQ(external.points[0][0].file, "a.exr");
  EXPECT_EQ(external.points[1].size(), 2u);
  for (const char* bad : {"", "x", "=1:a", "x=", "x=a.exr", "x=0:a.exr", "x=1:", "x=1:a,", "x=1"}) {
    EXPECT_THROW(parse_external(bad), Error) << bad;
  }
}

}  // namespace
}  // namespace octolux
