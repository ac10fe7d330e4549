// Beckmann and GGX against their defining integrals, and visible normals against their density.
#include <gtest/gtest.h>

#include "core/microfacet.h"
#include "core/microfacet_albedo.h"
#include "tests/core/bsdf_testing.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

struct Roughness {
  MicrofacetKind kind;
  float alpha_u, alpha_v;
};

constexpr Roughness kSurfaces[] = {
    {MicrofacetKind::beckmann, 0.1f, 0.1f}, {MicrofacetKind::beckmann, 0.5f, 0.5f},
    {MicrofacetKind::beckmann, 0.2f, 0.8f}, {MicrofacetKind::ggx, 0.1f, 0.1f},
    {MicrofacetKind::ggx, 0.5f, 0.5f},      {MicrofacetKind::ggx, 1.0f, 0.3f}};

constexpr double kCosines[] = {1, 0.9, 0.5, 0.1, 0.02};

template <class F>
double over_hemisphere(const F& f) {
  return integrate(f, {0, std::numbers::pi / 2, 0, 2 * std::numbers::pi}, 1e-5, 5, 12);
}

TEST(Microfacet, AreaProjectsToOne) {
  for (const Roughness& r : kSurfaces) {
    const Microfacet m(r.kind, r.alpha_u, r.alpha_v);
    EXPECT_NEAR(over_hemisphere([&](Vec3 n) { return m.d(n) * n.z; }), 1, 2e-5);
  }
}

TEST(Microfacet, VisibleAreaProjectsToTheSurface) {
  // This is what defines Smith's G1: D G1 (w.m)+ integrates to cos w.
  for (const Roughness& r : kSurfaces) {
    const Microfacet m(r.kind, r.alpha_u, r.alpha_v);
    for (const double c : kCosines) {
      const Vec3 w = direction(c, 0.7);
      EXPECT_NEAR(over_hemisphere([&](Vec3 n) { return m.visible_pdf_w(w, n); }), 1, 5e-5)
          << int(r.kind) << " " << r.alpha_u << " " << c;
    }
  }
}

TEST(Microfacet, MaskingSeesOneSideOnly) {
  const Microfacet m(MicrofacetKind::ggx, 0.5f, 0.5f);
  const Vec3 n = direction(0.3, 0);
  EXPECT_EQ(m.g1(direction(0.2, std::numbers::pi), n), 0);
  EXPECT_EQ(m.g1(direction(0.8, 0), Vec3{0, 0, 1}), m.g1(direction(-0.8, 0), Vec3{0, 0, 1}));
  EXPECT_EQ(m.g1({0, 0, 1}, n), 1);
}

TEST(Microfacet, SamplesVisibleNormals) {
  const double alpha = sidak(kAlpha, 6 * 5);
  const SphereGrid grid{40, 24};
  constexpr int kSamples = 100000;
  for (const Roughness& r : kSurfaces) {
    const Microfacet m(r.kind, r.alpha_u, r.alpha_v);
    for (const double c : kCosines) {
      const Vec3 w = direction(c, 0.7);
      std::vector<double> observed(std::size_t(grid.size())), expected(std::size_t(grid.size()));
      for (int i = 0; i < kSamples; ++i) {
        Rng rng(3, Stream::test, 0, static_cast<std::uint64_t>(i));
        ++observed[std::size_t(grid.index(m.sample_visible(w, rng.uniform2())))];
      }
      for (int i = 0; i < grid.size() / 2; ++i) {  // above the horizon
        const auto pdf = [&](Vec3 n) { return m.visible_pdf_w(w, n); };
        expected[std::size_t(i)] = kSamples * integrate(pdf, grid.cell(i), 1e-6);
      }
      EXPECT_GT(chi2_test_p(observed, expected), alpha)
          << int(r.kind) << " " << r.alpha_u << " " << r.alpha_v << " cos " << c;
    }
  }
}

TEST(Microfacet, SamplesAreFiniteAtTheEdges) {
  for (const MicrofacetKind kind : {MicrofacetKind::beckmann, MicrofacetKind::ggx}) {
    for (const float alpha : {0.0f, 0.1f, 1.0f}) {
      const Microfacet m(kind, alpha, alpha);
      for (const double c : {1.0, 1e-3, 1e-6}) {
        for (const float x : {0.0f, 0x1p-24f, 0.5f, 0x1.fffffep-1f}) {
          for (const float y : {0.0f, 0.5f, 0x1.fffffep-1f}) {
            const Vec3 n = m.sample_visible(direction(c, 0), {x, y});
            EXPECT_TRUE(is_finite(n) && n.z >= 0) << c << " " << x << " " << y;
          }
        }
      }
    }
  }
}

TEST(CosineTable, InterpolatesAndIntegrates) {
  std::array<float, CosineTable::kSize> values;
  for (int i = 0; i < CosineTable::kSize; ++i) {
    values[std::size_t(i)] = 3 - 2 * float(i) / (CosineTable::kSize - 1);
  }
  const CosineTable table(values);
  for (const float c : {0.0f, 0.123f, 0.5f, 1.0f}) EXPECT_NEAR(table(c), 3 - 2 * c, 1e-6);
  EXPECT_NEAR(table.diffuse_mean(), 3 - 4.0 / 3, 1e-6);
}

/// Mean flux that the rough boundary of `eta` reflects (or transmits), by sampling it.
Running scattered(MicrofacetKind kind, float alpha, float eta, Vec3 wo, bool reflected) {
  const auto bsdf = make_rough_dielectric({{eta, Rgb(1), Rgb(1)}, {kind, alpha, alpha}});
  Running mean;
  for (int i = 0; i < 40000; ++i) {
    Rng rng(4, Stream::test, 0, static_cast<std::uint64_t>(i));
    const float u_lobe = rng.uniform();
    const auto s = bsdf->sample({}, wo, u_lobe, rng.uniform2(), Lobes::all, Carried::flux);
    const bool counts = s && (s->wi.z > 0) == reflected;
    mean.add(counts ? static_cast<double>(s->weight.r) : 0.0);
  }
  return mean;
}

TEST(MicrofacetAlbedo, EqualsWhatRoughGlassScatters) {
  const double alpha = sidak(kAlpha, 2 * 2 * 3 * 2);
  for (const MicrofacetKind kind : {MicrofacetKind::beckmann, MicrofacetKind::ggx}) {
    for (const float eta : {1.5f, 1 / 1.5f}) {
      const Microfacet m(kind, 0.3f, 0.3f);
      const CosineTable r = rough_reflectance(m, eta), t = rough_transmittance(m, eta);
      for (const int entry : {63, 40, 25}) {
        const Vec3 wo = direction(static_cast<double>(CosineTable::cosine(entry)), 0);
        EXPECT_GT(z_test_p(scattered(kind, 0.3f, eta, wo, true).z(r[entry])), alpha) << entry;
        EXPECT_GT(z_test_p(scattered(kind, 0.3f, eta, wo, false).z(t[entry])), alpha) << entry;
      }
    }
  }
}

}  // namespace
}  // namespace octolux
