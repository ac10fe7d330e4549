// Conservation laws every BSDF obeys: reciprocity, no more light out than in, the same mean however
// its lobes are split up.
#include <gtest/gtest.h>

#include "core/constants.h"
#include "core/fresnel.h"
#include "tests/core/bsdf_testing.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

const SurfacePoint kPoint = test::flat_point();

class BsdfEnergy : public testing::TestWithParam<BsdfCase> {
 protected:
  static float inside_index() {
    if (GetParam().name.starts_with("principled_thin")) return 1;   // nothing is bent
    return GetParam().name.ends_with("bubble") ? 1 / 1.33f : 1.5f;  // see bsdf_cases
  }
};
class WhiteFurnace : public testing::TestWithParam<BsdfCase> {};

/// Weight of one sample, black if there is none.
Rgb scattered(const Bsdf& bsdf, Vec3 wo, Lobes lobes, Carried carried, Rng& rng) {
  const float u_lobe = rng.uniform();
  const Vec2 u = rng.uniform2();
  const auto s = bsdf.sample(kPoint, wo, u_lobe, u, lobes, carried);
  return s ? s->weight : Rgb(0);
}

Vec3 random_direction(Rng& rng, bool both_sides) {
  const float z = rng.uniform();
  const float phi = rng.uniform();
  return direction(both_sides ? 2 * z - 1 : z, 2 * kPi * phi);
}

/// A direction the BSDF scatters into, or any if it scatters into none.
Vec3 likely_direction(const Bsdf& bsdf, Vec3 wo, Rng& rng) {
  const float u_lobe = rng.uniform();
  const Vec2 u = rng.uniform2();
  const auto s = bsdf.sample(kPoint, wo, u_lobe, u, Lobes::all, Carried::flux);
  return s ? s->wi : random_direction(rng, true);
}

TEST_P(BsdfEnergy, IsReciprocal) {
  const Built built = GetParam().build();
  for (int i = 0; i < 2000; ++i) {
    Rng rng(5, Stream::test, 0, static_cast<std::uint64_t>(i));
    const Vec3 a = random_direction(rng, GetParam().two_faced);
    const Vec3 b = likely_direction(*built.bsdf, a, rng);
    const Rgb radiance = built.bsdf->f(kPoint, a, b, Lobes::all, Carried::radiance);
    const Rgb flux = built.bsdf->f(kPoint, a, b, Lobes::all, Carried::flux);
    const Rgb back = built.bsdf->f(kPoint, b, a, Lobes::all, Carried::radiance);
    if (is_black(flux)) continue;
    const float eta = a.z * b.z > 0 ? 1 : std::sqrt(flux.g / radiance.g);
    EXPECT_NEAR(eta, a.z * b.z > 0 ? 1 : a.z > 0 ? inside_index() : 1 / inside_index(), 1e-5);
    const double both_ways = condition(a, b, eta) + condition(b, a, 1 / eta);
    const double relative = 16 * 0x1p-24 * both_ways * GetParam().d_sensitivity();
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(flux[c], back[c], relative * back[c]) << i;
  }
}

TEST_P(BsdfEnergy, SumOfKindsIsTheWhole) {
  const Built built = GetParam().build();
  for (int i = 0; i < 1000; ++i) {
    Rng rng(6, Stream::test, 0, static_cast<std::uint64_t>(i));
    const Vec3 wo = random_direction(rng, GetParam().two_faced);
    const Vec3 wi = likely_direction(*built.bsdf, wo, rng);
    const auto f = [&](Lobes lobes) {
      return built.bsdf->f(kPoint, wo, wi, lobes, Carried::radiance);
    };
    const Rgb parts = f(Lobes::smooth) + f(Lobes::near_specular);
    for (int c = 0; c < 3; ++c) ASSERT_FLOAT_EQ(f(Lobes::all)[c], parts[c]);
    ASSERT_EQ(f(Lobes::delta), Rgb(0));
    ASSERT_TRUE(built.bsdf->has(Lobes::smooth) || is_black(f(Lobes::smooth)));
  }
}

TEST_P(BsdfEnergy, SamplingKindsApartHasTheSameMean) {
  const Built built = GetParam().build();
  constexpr int kSamples = 20000;
  for (const Vec3 wo : views(GetParam().two_faced)) {
    Running difference;
    for (int i = 0; i < kSamples; ++i) {
      Rng rng(7, Stream::test, 0, static_cast<std::uint64_t>(i));
      Rgb apart(0);
      for (const Lobes kind : {Lobes::smooth, Lobes::near_specular, Lobes::delta}) {
        apart += scattered(*built.bsdf, wo, kind, Carried::radiance, rng);
      }
      const Rgb together = scattered(*built.bsdf, wo, Lobes::all, Carried::radiance, rng);
      difference.add(static_cast<double>(mean(apart) - mean(together)));
    }
    // Where both are constants they agree to rounding, and z would be 0/0.
    const double floor = 1e-5;
    if (std::abs(difference.mean()) < floor) continue;
    EXPECT_GT(z_test_p(difference.z(0)), sidak(kAlpha, 40 * 5)) << GetParam().name << wo.z;
  }
}

TEST_P(WhiteFurnace, ReflectsNoMoreThanItReceives) {
  const Built built = GetParam().build();
  constexpr int kSamples = 20000;
  const double alpha = sidak(kAlpha, 40 * 5 * 3);
  for (const Vec3 wo : views(GetParam().two_faced)) {
    Running sum[3];
    for (int i = 0; i < kSamples; ++i) {
      Rng rng(8, Stream::test, 0, static_cast<std::uint64_t>(i));
      const Rgb weight = scattered(*built.bsdf, wo, Lobes::all, Carried::flux, rng) +
                         built.bsdf->pass_through(kPoint, wo);
      for (int c = 0; c < 3; ++c) sum[c].add(static_cast<double>(weight[c]));
    }
    for (const Running& s : sum) {
      const bool too_much = s.mean() > 1 + 1e-5 && z_test_p(s.z(1)) < alpha;
      EXPECT_FALSE(too_much) << GetParam().name << " " << wo.z << " " << s.mean();
      EXPECT_GT(s.mean(), 0.3) << GetParam().name << " " << wo.z;  // white, after all
    }
  }
}

TEST(LosslessGlass, ScattersEverything) {
  for (const float eta : {1.5f, 1 / 1.5f}) {
    const auto bsdf = make_dielectric({eta, Rgb(1), Rgb(1)});
    for (const Vec3 wo : views(true)) {
      for (const float u : {0.0f, 0.03f, 0.5f, kOneMinusEpsilon}) {
        const auto s = bsdf->sample(kPoint, wo, u, {}, Lobes::all, Carried::flux);
        ASSERT_TRUE(s);
        EXPECT_EQ(s->weight, Rgb(1));
      }
    }
  }
}

TEST(LosslessGlass, RadianceIsScaledByTheIndexOnItsWay) {
  const auto bsdf = make_dielectric({1.5f, Rgb(1), Rgb(1)});
  // Seen from outside, what comes from inside, where radiance is 1.5^2 times as dense.
  const auto in = bsdf->sample(kPoint, direction(0.8, 0), 0.9f, {}, Lobes::all, Carried::radiance);
  EXPECT_LT(in->wi.z, 0);
  EXPECT_FLOAT_EQ(in->eta, 1.5f);
  EXPECT_FLOAT_EQ(in->weight.r, 1 / 2.25f);
  const auto out =
      bsdf->sample(kPoint, direction(-0.9, 0), 0.9f, {}, Lobes::all, Carried::radiance);
  EXPECT_GT(out->wi.z, 0);
  EXPECT_FLOAT_EQ(out->eta, 1 / 1.5f);
  EXPECT_FLOAT_EQ(out->weight.r, 2.25f);
}

TEST(LosslessGlass, ThinPaneReflectsOrPassesEverything) {
  const auto bsdf = make_thin_dielectric({1.5f, Rgb(1), Rgb(1)});
  for (const Vec3 wo : views(true)) {
    const auto s = bsdf->sample(kPoint, wo, 0.99f, {}, Lobes::delta, Carried::flux);
    ASSERT_TRUE(s);
    const float r = fresnel_dielectric(std::abs(wo.z), 1.5f).reflectance;
    EXPECT_FLOAT_EQ(s->weight.g, 2 * r / (1 + r));
    EXPECT_FLOAT_EQ(s->weight.g + bsdf->pass_through(kPoint, wo).g, 1);
    EXPECT_EQ(s->wi, reflect(wo));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BsdfEnergy, testing::ValuesIn(bsdf_cases()),
                         [](const auto& c) { return c.param.name; });
INSTANTIATE_TEST_SUITE_P(Kinds, WhiteFurnace, testing::ValuesIn(bsdf_cases(true)),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace octolux
