// Pixel filters: profiles of Mitsuba's box, tent and gaussian.
#include "core/filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace octolux {
namespace {

const Filter kBox{Filter::Kind::box, 0.5f, 0};
const Filter kTent{Filter::Kind::tent, 1, 0};
const Filter kGaussian{Filter::Kind::gaussian, 2, 0.5f};

TEST(Filter, ProfilesAreMitsubas) {
  EXPECT_EQ(kBox.profile(-0.5f), 1);
  EXPECT_EQ(kBox.profile(0.5f), 0);
  EXPECT_EQ(kTent.profile(0.25f), 0.75f);
  for (const float x : {0.0f, 0.3f, 1.1f, 1.9f}) {
    EXPECT_NEAR(kGaussian.profile(x), std::exp(-2.0 * x * x) - std::exp(-8.0), 1e-7);
    EXPECT_EQ(kGaussian.profile(x), kGaussian.profile(-x));
  }
}

TEST(Filter, EndsAtItsReach) {
  for (const Filter& filter : {kBox, kTent, kGaussian, Filter{Filter::Kind::tent, 2.5f, 0}}) {
    EXPECT_GT(filter.profile(0.95f * filter.reach()), 0);
    EXPECT_EQ(filter.profile(filter.reach()), 0);
    EXPECT_EQ(filter.profile(-1.01f * filter.reach()), 0);
  }
}

TEST(Filter, BoxAndTentSharesAddUpToOne) {
  // Wherever a pass puts its samples, a pixel's weights add up to the same: no brightness flicker.
  for (const Filter& filter : {kBox, kTent}) {
    for (int i = 0; i < 64; ++i) {
      const float offset = static_cast<float>(i) / 64 - 0.5f;
      float sum = 0;
      for (int k = -3; k <= 3; ++k) sum += filter.profile(offset + static_cast<float>(k));
      EXPECT_EQ(sum, 1);
    }
  }
}

}  // namespace
}  // namespace octolux
