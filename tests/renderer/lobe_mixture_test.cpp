// renderer/lobe_mixture.h: the density is that of the samples.
#include "renderer/lobe_mixture.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "core/sampling.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

struct Case {
  const char* name;
  LobeMixture lobes;
};

/// Lobes all over the sphere.
LobeMixture spread(std::size_t count) {
  LobeMixture lobes;
  for (std::size_t i = 0; i < count; ++i) {
    Rng rng(7, Stream::test, 0, i);
    const Vec3 axis = sample_sphere(rng.uniform2());
    const float sharpness = std::pow(1000.0f, rng.uniform());
    lobes.add(axis, sharpness, 1 / static_cast<float>(count));
  }
  return lobes;
}

std::vector<Case> cases() {
  const Vec3 slant{0.6f, 0, 0.8f};
  LobeMixture one, wide, two, uneven;
  one.add(slant, 1000, 1);
  wide.add({0, 0, -1}, 1, 1);
  two.add(slant, 100, 0.75f);
  two.add(-slant, 10, 0.25f);
  uneven.add(slant, 30, 0);  // never chosen
  for (int i = 0; i < 8; ++i) uneven.add({0, 1, 0}, 30, 0.125f);
  return {{"one", one},         {"wide", wide},
          {"two", two},         {"uneven", uneven},
          {"seven", spread(7)}, {"eight", spread(8)},
          {"nine", spread(9)},  {"all", spread(LobeMixture::kMost)}};
}

/// The cell of a grid equal in area to which `w` belongs.
std::size_t cell(Vec3 w) {
  const auto row = static_cast<std::size_t>(std::clamp((1 - w.z) * 16, 0.0f, 31.0f));
  const float turn = std::atan2(w.y, w.x) / (2 * kPi) + 0.5f;
  return row * 64 + static_cast<std::size_t>(std::clamp(turn * 64, 0.0f, 63.0f));
}

TEST(LobeMixture, DensityIsThatOfTheSamples) {
  constexpr int kSamples = 200000;
  constexpr int kFine = 32;  // integration steps a cell and axis
  const std::vector<Case> all = cases();
  for (const Case& c : all) {
    std::vector<double> observed(32 * 64), expected(32 * 64);
    for (int i = 0; i < kSamples; ++i) {
      Rng rng(8, Stream::test, 0, static_cast<std::uint64_t>(i));
      ++observed[cell(c.lobes.sample(rng.uniform2()))];
    }
    double integral = 0;
    for (int i = 0; i < 32 * kFine; ++i) {
      for (int j = 0; j < 64 * kFine; ++j) {
        const Vec3 w = sample_sphere({(i + 0.5f) / (32 * kFine), (j + 0.5f) / (64 * kFine)});
        const double p = c.lobes.pdf_w(w) * 4 * kPi / (32 * kFine * 64 * kFine);
        expected[cell(w)] += p * kSamples;
        integral += p;
      }
    }
    EXPECT_NEAR(integral, 1, 2e-3) << c.name;  // midpoint rule over lobes of 2.6 degrees
    EXPECT_GT(chi2_test_p(observed, expected), sidak(kAlpha, static_cast<double>(all.size())))
        << c.name;
  }
}

TEST(LobeMixture, SharpnessTellsWithinWhatHalfOfALobeLies) {
  for (const float sharpness : {1.0f, 30.0f, 4000.0f}) {
    LobeMixture lobe;
    lobe.add({0, 0.6f, 0.8f}, sharpness, 1);
    const Vec3 w = lobe.sample({0.5f, 0.3f});  // by inversion: the median
    EXPECT_NEAR(1 - dot(w, Vec3{0, 0.6f, 0.8f}), 1 / (1 + sharpness), 1e-6f);
    EXPECT_NEAR(length(w), 1, 1e-5);
  }
}

TEST(LobeMixture, OfNothingHasNoDensity) {
  EXPECT_TRUE(LobeMixture().empty());
  EXPECT_EQ(LobeMixture().pdf_w({0, 0, 1}), 0);
}

}  // namespace
}  // namespace octolux::test
