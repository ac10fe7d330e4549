// The corrected kernels held to what they must reach (tools/lab/reach.h). A figure passes if it is
// within its limit by the standard error that the number of tests asks for.
#include "tools/lab/reach.h"

#include <gtest/gtest.h>

#include "tests/stats.h"

namespace octolux {
namespace {

constexpr double kDeviates = 4.5;  // of 300 comparisons, one in 10^4 suites

LabSettings settings_for(const char* kernel, int runs) {
  LabSettings settings;
  settings.kernels = {parse_lab_kernel(kernel)};
  settings.runs = runs;
  return settings;
}

TEST(ReachSlow, BiasOfOctoBox) {
  for (const ReachMeasure& measure : reach_measures()) {
    const bool plane = measure.limit < 0.01;
    // On the plane a standard error of a fifth of the limit.
    const LabSettings settings = settings_for("octobox", plane ? 30000 : 3000);
    for (const LabResult& r : worst_bias(measure, settings)) {
      EXPECT_LT(std::abs(r.bias()) - kDeviates * r.standard_error, measure.limit)
          << measure.name << " n " << r.neighbours << ": " << r.bias() << " +- "
          << r.standard_error;
    }
  }
}

TEST(ReachSlow, BiasOfFeelerAndRegion) {
  for (const ReachMeasure& measure : reach_measures()) {
    const bool plane = measure.feeler_limit < 0.01;
    LabSettings settings = settings_for("feeler", plane ? 6000 : 1000);
    settings.kernels.push_back(parse_lab_kernel("region"));
    for (const LabResult& r : worst_bias(measure, settings)) {
      EXPECT_LT(std::abs(r.bias()) - kDeviates * r.standard_error, measure.feeler_limit)
          << r.kernel << " " << measure.name << " n " << r.neighbours << ": " << r.bias() << " +- "
          << r.standard_error;
    }
  }
}

TEST(ReachSlow, NoiseOfFeelerAndRegion) {
  LabSettings settings = settings_for("feeler", 20000);
  settings.kernels.push_back(parse_lab_kernel("region"));
  for (const double ratio : worst_noise(settings, {50, 80, 150})) {
    EXPECT_LT(ratio, 1.1 + 4 / std::sqrt(6000.0));
  }
  for (const double ratio : worst_noise(settings, {5, 10, 20, 40})) EXPECT_LT(ratio, 1.3);
}

TEST(ReachSlow, NoiseOfOctoBox) {
  // A ratio of two standard deviations of the same photons: its own is below 1 / sqrt(runs).
  const LabSettings settings = settings_for("octobox", 40000);
  EXPECT_LT(worst_noise(settings, {50, 60, 80, 100, 150, 200})[0], 1.1 + 4 / std::sqrt(10000.0));
  EXPECT_LT(worst_noise(settings, {5, 7, 10, 15, 20, 30, 40})[0], 1.3);
}

TEST(Reach, ACoarseLook) {
  for (const ReachMeasure& measure : reach_measures()) {
    ReachMeasure coarse = measure;
    coarse.neighbours = {50, 200};
    for (const LabResult& r : worst_bias(coarse, settings_for("octobox", 400))) {
      EXPECT_LT(std::abs(r.bias()) - kDeviates * r.standard_error, measure.limit)
          << measure.name << " n " << r.neighbours << ": " << r.bias();
    }
  }
}

// With a share of the disc left at the photons of a render's look-up, every wall and corner is
// darker by that share of a half and of three quarters.
TEST(Reach, ALookUpOfARenderHasPhotonsEnoughForABox) {
  const int neighbours = EstimatorConfig{}.neighbours;
  const ReachMeasure walls{
      "at walls and in corners", 0.03, 0.03, {{"wall", 0, 0}, {"corner", 0, 0}}, {neighbours}};
  for (const LabResult& r : worst_bias(walls, settings_for("octobox", 8000))) {
    EXPECT_LT(std::abs(r.bias()) - kDeviates * r.standard_error, walls.limit)
        << r.bias() << " +- " << r.standard_error;
  }
}

TEST(Reach, TheMeasuresCanFail) {
  for (const ReachMeasure& measure : reach_measures()) {
    if (measure.limit < 0.01) continue;
    ReachMeasure coarse = measure;
    coarse.neighbours = {100};
    coarse.places.resize(1);
    if (std::string(coarse.places[0].lab_case) == "plane" || coarse.places[0].distance == 0.6) {
      continue;
    }
    const LabResult disc = worst_bias(coarse, settings_for("disc", 400))[0];
    EXPECT_GT(std::abs(disc.bias()), measure.limit) << measure.name;
  }
}

}  // namespace
}  // namespace octolux
