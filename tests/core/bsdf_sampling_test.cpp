// Every BSDF draws directions with the density it states, for every set of lobe kinds, and its
// weights are f cos / pdf.
#include <gtest/gtest.h>

#include "core/constants.h"
#include "tests/core/bsdf_testing.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

constexpr Lobes kMasks[] = {Lobes::all, Lobes::smooth, Lobes::non_delta, Lobes::specular};
/// Comparisons of this file, for Sidak's correction: cases, views and masks.
constexpr double kComparisons = 40 * 5 * 4;

class BsdfSampling : public testing::TestWithParam<BsdfCase> {};

/// Observed and expected counts: grid cells, then delta samples, then none at all.
struct Counts {
  std::vector<double> observed, expected;
};

Counts count(const Bsdf& bsdf, Vec3 wo, Lobes mask, int samples) {
  const SphereGrid grid;
  const SurfacePoint at = flat_point();
  const auto cells = static_cast<std::size_t>(grid.size());
  Counts counts{std::vector<double>(cells + 2), std::vector<double>(cells + 2)};
  // Delta lobes lie in at most two directions, each with its own probability.
  double up = 0, down = 0;
  for (int i = 0; i < samples; ++i) {
    Rng rng(1, Stream::test, static_cast<std::uint64_t>(mask), static_cast<std::uint64_t>(i));
    const float u_lobe = rng.uniform();
    const Vec2 u = rng.uniform2();
    const auto s = bsdf.sample(at, wo, u_lobe, u, mask, Carried::radiance);
    std::size_t slot = cells + 1;
    if (s && s->lobe == Lobes::delta) {
      slot = cells;
      (s->wi.z > 0 ? up : down) = s->pdf_w;
    } else if (s) {
      slot = static_cast<std::size_t>(grid.index(s->wi));
    }
    ++counts.observed[slot];
  }
  double none = 1 - up - down;
  for (std::size_t i = 0; i < cells; ++i) {
    const auto pdf = [&](Vec3 wi) { return bsdf.pdf_w(at, wo, wi, mask); };
    const double p = integrate(pdf, grid.cell(static_cast<int>(i)), 1e-6);
    counts.expected[i] = p * samples;
    none -= p;
  }
  counts.expected[cells] = (up + down) * samples;
  counts.expected[cells + 1] = std::max(0.0, none) * samples;
  return counts;
}

TEST_P(BsdfSampling, FollowsItsDensity) {
  const Built built = GetParam().build();
  constexpr int kSamples = 60000;
  for (const Vec3 wo : views(GetParam().two_faced)) {
    for (const Lobes mask : kMasks) {
      if (!built.bsdf->has(mask)) continue;
      const Counts counts = count(*built.bsdf, wo, mask, kSamples);
      EXPECT_GT(chi2_test_p(counts.observed, counts.expected), sidak(kAlpha, kComparisons))
          << GetParam().name << " wo.z " << wo.z << " mask " << unsigned(mask);
    }
  }
}

TEST_P(BsdfSampling, DensityIntegratesToAtMostOneLessTheDeltaShare) {
  const Built built = GetParam().build();
  const SurfacePoint at = flat_point();
  for (const Vec3 wo : views(GetParam().two_faced)) {
    for (const Lobes mask : kMasks) {
      const auto pdf = [&](Vec3 wi) { return built.bsdf->pdf_w(at, wo, wi, mask); };
      double sum = 0;
      for (int i = 0; i < SphereGrid().size(); ++i)
        sum += integrate(pdf, SphereGrid().cell(i), 1e-6);
      double delta = 0;
      for (const float u : {0.0f, kOneMinusEpsilon}) {
        const auto s = built.bsdf->sample(at, wo, u, {0.5f, 0.5f}, mask, Carried::flux);
        if (s && s->lobe == Lobes::delta) delta = std::min(1.0, delta + s->pdf_w);
      }
      const double tolerance = 1e-6 * SphereGrid().size() + 1e-5;  // quadrature, single precision
      EXPECT_LE(sum, 1 - delta + tolerance) << GetParam().name << unsigned(mask);
      if (GetParam().has_microfacets() || GetParam().partial || sum == 0)
        continue;  // some reflect downwards
      EXPECT_GE(sum, 1 - delta - tolerance) << GetParam().name << unsigned(mask);
    }
  }
}

TEST_P(BsdfSampling, WeightIsFCosOverPdf) {
  const Built built = GetParam().build();
  const SurfacePoint at = flat_point();
  for (int i = 0; i < 4000; ++i) {
    Rng rng(2, Stream::test, 0, static_cast<std::uint64_t>(i));
    const float z = rng.uniform();
    const float phi = rng.uniform();
    const Vec3 wo = direction(GetParam().two_faced ? 2 * z - 1 : z, 2 * kPi * phi);
    const float u_lobe = rng.uniform();
    const Vec2 u = rng.uniform2();
    const Lobes mask = kMasks[rng.next() % 4];
    const Carried carried = rng.uniform() < 0.5f ? Carried::flux : Carried::radiance;
    const auto s = built.bsdf->sample(at, wo, u_lobe, u, mask, carried);
    if (!s) continue;
    ASSERT_TRUE(any(s->lobe & mask));
    ASSERT_NEAR(length(s->wi), 1, 1e-5);
    if (s->lobe == Lobes::delta) continue;
    const float pdf = built.bsdf->pdf_w(at, wo, s->wi, mask);
    const Rgb f = built.bsdf->f(at, wo, s->wi, mask, carried);
    const Rgb expected = f * (std::abs(s->wi.z) / pdf);
    const double ulp = 16 * 0x1p-24 * condition(wo, s->wi, s->eta);
    ASSERT_NEAR(pdf, s->pdf_w, ulp * GetParam().d_sensitivity() * s->pdf_w)
        << GetParam().name << " " << i;
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(expected[c], s->weight[c], ulp * s->weight[c]) << GetParam().name << " " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BsdfSampling, testing::ValuesIn(bsdf_cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace octolux
