// The learned density: a distribution over the cube, the one it says, that finds what is of use and
// nothing in noise.
#include "renderer/emission_density.h"

#include <gtest/gtest.h>

#include <functional>

#include "renderer/learn_emission.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

std::vector<EmissionDensity::Trial> trials(
    int count, const std::function<double(const EmissionPoint&, Rng&)>& use) {
  std::vector<EmissionDensity::Trial> out;
  Rng rng(1, Stream::test, 300, 0);
  for (int i = 0; i < count; ++i) {
    EmissionDensity::Trial t;
    for (float& u : t.at) u = rng.uniform();
    t.use = use(t.at, rng);
    out.push_back(t);
  }
  return out;
}

/// A window that moves with the direction, seen by a third of the lights: 1/48 of the cube.
double window(const EmissionPoint& at, Rng&) {
  const float x = at[1] - 0.5f * at[3];
  return at[0] < 1 / 3.0f && x >= 0 && x < 0.25f && at[2] >= 0.25f && at[2] < 0.5f ? 2.5 : 0;
}

TEST(EmissionDensity, UniformUnlessTold) {
  const EmissionDensity plain, useless(trials(1000, [](const auto&, Rng&) { return 0.0; }));
  for (const EmissionDensity* density : {&plain, &useless}) {
    EXPECT_TRUE(density->uniform());
    EXPECT_EQ(density->gain(), 1);
    Rng rng(1, Stream::test, 301, 0);
    const EmissionDensity::Sample s = density->sample(0.625, rng);
    EXPECT_EQ(s.at[0], 0.625f);
    EXPECT_EQ(s.weight, 1);
    EXPECT_EQ(density->density(s.at), 1);
  }
}

TEST(EmissionDensity, FindsWhatIsOfUse) {
  const EmissionDensity density(trials(100'000, window));
  EXPECT_GT(density.gain(), 12);
  EXPECT_LT(density.gain(), 48);
  Rng rng(1, Stream::test, 302, 0);
  constexpr int kDraws = 10'000;
  int useful = 0;
  for (int i = 0; i < kDraws; ++i) {
    useful += window(density.sample((i + 0.5) / kDraws, rng).at, rng) > 0;
  }
  EXPECT_GT(useful, kDraws / 3);  // by uniform density 1/48 of them
}

/// Whatever was learned, weighted samples are uniform, and weights are bounded.
TEST(EmissionDensity, WeightsUndoIt) {
  const EmissionDensity density(trials(50'000, window));
  constexpr int kDraws = 200'000;
  Running total, corner, across;
  Rng rng(1, Stream::test, 303, 0);
  for (int i = 0; i < kDraws; ++i) {
    const EmissionDensity::Sample s = density.sample(static_cast<double>(rng.uniform()), rng);
    const auto w = static_cast<double>(s.weight);
    ASSERT_LE(w, 1 / EmissionDensity::kDefensiveShare * (1 + 1e-6));
    ASSERT_GT(w, 0);
    for (const float u : s.at) ASSERT_TRUE(u >= 0 && u < 1);
    total.add(w);
    corner.add(s.at[0] < 0.5f && s.at[1] < 0.5f ? w : 0);
    across.add(s.at[1] + s.at[2] < s.at[3] ? w : 0);
  }
  EXPECT_GT(z_test_p(total.z(1)), kAlpha / 3) << total.mean();
  EXPECT_GT(z_test_p(corner.z(0.25)), kAlpha / 3) << corner.mean();
  EXPECT_GT(z_test_p(across.z(1.0 / 6)), kAlpha / 3) << across.mean();
}

/// Samples fall as density() says: over uniform points it is 1 on average, and where they are drawn
/// it is 1 / weight (but on the very border between boxes).
TEST(EmissionDensity, DensityIsThatOfSamples) {
  const EmissionDensity density(trials(50'000, window));
  Running mean;
  int borders = 0;
  Rng rng(1, Stream::test, 304, 0);
  for (int i = 0; i < 100'000; ++i) {
    EmissionPoint at;
    for (float& u : at) u = rng.uniform();
    mean.add(density.density(at));
    const EmissionDensity::Sample s = density.sample(static_cast<double>(rng.uniform()), rng);
    borders += std::abs(density.density(s.at) * static_cast<double>(s.weight) - 1) > 1e-6;
  }
  EXPECT_GT(z_test_p(mean.z(1)), kAlpha) << mean.mean();
  EXPECT_LT(borders, 10);  // 5 coordinates of 24 bits, boxes of side 2^-16 or more
}

/// Use that has nothing to do with the place teaches nothing, even if rare and uneven.
TEST(EmissionDensity, NoiseIsNotLearned) {
  for (const double share : {0.5, 0.02}) {
    const EmissionDensity density(trials(20'000, [share](const EmissionPoint&, Rng& rng) {
      const bool useful = static_cast<double>(rng.uniform()) < share;
      const float size = rng.uniform();
      return useful ? 0.1 / static_cast<double>(size + 0.01f) : 0;
    }));
    EXPECT_LT(density.gain(), kWorthwhileGain) << share;
  }
}

}  // namespace
}  // namespace octolux
