// Pixel filters: their profiles are Mitsuba's.
#include "core/filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace octolux {
namespace {

const Filter kBox{Filter::Kind::box, 0.5f, 0};
const Filter kTent{Filter::Kind::tent, 1, 0};
const Filter kGaussian{Filter::Kind::gaussian, 2, 0.5f};
const Filter kMitchell{.kind = Filter::Kind::mitchell, .radius = 2};
const Filter kCatmullRom{.kind = Filter::Kind::mitchell, .radius = 2, .b = 0, .c = 0.5f};
const Filter kLanczos{.kind = Filter::Kind::lanczos, .radius = 3};

TEST(Filter, ProfilesAreMitsubas) {
  EXPECT_EQ(kBox.profile(-0.5f), 1);
  EXPECT_EQ(kBox.profile(0.5f), 0);
  EXPECT_EQ(kTent.profile(0.25f), 0.75f);
  for (const float x : {0.0f, 0.3f, 1.1f, 1.9f}) {
    EXPECT_NEAR(kGaussian.profile(x), std::exp(-2.0 * x * x) - std::exp(-8.0), 1e-7);
    EXPECT_EQ(kGaussian.profile(x), kGaussian.profile(-x));
  }
}

TEST(Filter, CubicsAreMitchellAndNetravalis) {
  // The paper's values at 0 and 1; Catmull & Rom's interpolates: 1 at 0, 0 at all other integers.
  EXPECT_FLOAT_EQ(kMitchell.profile(0), 8.0f / 9);
  EXPECT_FLOAT_EQ(kMitchell.profile(1), 1.0f / 18);
  EXPECT_FLOAT_EQ(kCatmullRom.profile(0), 1);
  EXPECT_NEAR(kCatmullRom.profile(-1), 0, 1e-7);
  EXPECT_FLOAT_EQ(kCatmullRom.profile(0.5f), 9.0f / 16);
  EXPECT_FLOAT_EQ(kCatmullRom.profile(-1.5f), -1.0f / 16);
  // B-splines (b = 1, c = 0) are positive.
  const Filter spline{.kind = Filter::Kind::mitchell, .radius = 2, .b = 1, .c = 0};
  EXPECT_FLOAT_EQ(spline.profile(0), 2.0f / 3);
  EXPECT_FLOAT_EQ(spline.profile(1.5f), 1.0f / 48);
}

TEST(Filter, LanczosIsAWindowedSinc) {
  EXPECT_EQ(kLanczos.profile(0), 1);
  for (const float x : {0.3f, 1.5f, 2.2f}) {
    const double a = M_PI * static_cast<double>(x);
    EXPECT_NEAR(kLanczos.profile(x), std::sin(a) / a * std::sin(a / 3) / (a / 3), 1e-6);
    EXPECT_EQ(kLanczos.profile(x), kLanczos.profile(-x));
  }
}

TEST(Filter, ReachIsWhereAllOfThemEnd) {
  for (const Filter& filter : {kMitchell, kCatmullRom, kLanczos}) {
    EXPECT_NE(filter.profile(0.9f * filter.reach()), 0);
    EXPECT_NEAR(filter.profile(filter.reach()), 0, 1e-7);
    EXPECT_EQ(filter.profile(-1.01f * filter.reach()), 0);
  }
}

TEST(Filter, EndsAtItsReach) {
  for (const Filter& filter : {kBox, kTent, kGaussian, Filter{Filter::Kind::tent, 2.5f, 0}}) {
    EXPECT_GT(filter.profile(0.95f * filter.reach()), 0);
    EXPECT_EQ(filter.profile(filter.reach()), 0);
    EXPECT_EQ(filter.profile(-1.01f * filter.reach()), 0);
  }
}

/// Sum of a pixel's weights where a pass puts its samples at `offset` from the pixels' centres.
float sum_of_shares(const Filter& filter, float offset) {
  float sum = 0;
  for (int k = -4; k <= 4; ++k) sum += filter.profile(offset + static_cast<float>(k));
  return sum;
}

TEST(Filter, SharesOfTheOthersAddUpToOneOrNearly) {
  for (int i = 0; i < 64; ++i) {
    const float offset = static_cast<float>(i) / 64 - 0.5f;
    EXPECT_NEAR(sum_of_shares(kMitchell, offset), 1, 1e-6);
    EXPECT_NEAR(sum_of_shares(kCatmullRom, offset), 1, 1e-6);
    EXPECT_NEAR(sum_of_shares(kLanczos, offset), 1, 0.01);
  }
}

TEST(Filter, BoxAndTentSharesAddUpToOne) {
  // Wherever a pass puts its samples, a pixel's weights add up to the same: no brightness flicker.
  for (const Filter& filter : {kBox, kTent}) {
    for (int i = 0; i < 64; ++i) {
      EXPECT_EQ(sum_of_shares(filter, static_cast<float>(i) / 64 - 0.5f), 1);
    }
  }
}

}  // namespace
}  // namespace octolux
