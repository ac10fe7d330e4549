// Bump and normal maps: where the tilted normal points, that photons are scattered by the adjoint
// of what eye paths see, and that no light leaks through the surface.
#include <gtest/gtest.h>

#include "core/constants.h"
#include "core/sampling.h"
#include "core/scattering.h"
#include "tests/core/bsdf_testing.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

/// The normal of a diffuse surface shows where nothing is reflected any more: read it off instead
/// from a mirror, which sends the normal's own direction back.
Vec3 tilted_normal(const Bsdf& bsdf, const SurfacePoint& at) {
  const Vec3 wo{0, 0, 1};
  const auto s = bsdf.sample(at, wo, 0.5f, {0.5f, 0.5f}, Lobes::all, Carried::radiance);
  return s ? normalize(s->wi + wo) : Vec3{0, 0, 0};
}

TEST(TiltedBsdf, BumpMapHasTheNormalOfTheDisplacedSurface) {
  const SurfacePoint at = flat_point();  // dp_du = (2, 0, 0), dp_dv = (0, 3, 0)
  const Built built = bumped(make_conductor({}), {0.4f, -0.6f}, {});
  // Height 0.4 u - 0.6 v over x = 2 u, y = 3 v has slopes 0.2 and -0.2.
  const Vec3 expected = normalize({-0.2f, 0.2f, 1}), n = tilted_normal(*built.bsdf, at);
  EXPECT_NEAR(n.x, expected.x, 1e-6);
  EXPECT_NEAR(n.y, expected.y, 1e-6);
  EXPECT_NEAR(n.z, expected.z, 1e-6);
}

TEST(TiltedBsdf, BumpsFollowTheTangentsNotTheAxes) {
  SurfacePoint at = flat_point();
  at.dp_du = {0, 2, 0};  // turned by 90 degrees: local x is along world y
  at.dp_dv = {-2, 0, 0};
  const Built built = bumped(make_conductor({}), {0.4f, 0}, {});
  const Scattering seen(at, *built.bsdf, {0, 0, 1}, Carried::radiance);
  const auto s = seen.sample(0.5f, {0.5f, 0.5f}, Lobes::all);
  ASSERT_TRUE(s);
  const Vec3 n = normalize(s->wi + Vec3{0, 0, 1});
  EXPECT_NEAR(n.x, 0, 1e-6);
  EXPECT_NEAR(n.y, normalize({0, -0.2f, 1}).y, 1e-6);
}

TEST(TiltedBsdf, NormalMapIsInTheTangentFrame) {
  const auto mirror = make_conductor({});
  const Vec3 n = normalize({0.3f, -0.2f, 0.8f});
  const Rgb colour{0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z};
  const auto bsdf = make_normal_map(*mirror, colour);
  const Vec3 seen = tilted_normal(*bsdf, flat_point());
  EXPECT_NEAR(dot(seen, n), 1, 1e-6);
}

TEST(TiltedBsdf, NothingGoesThroughTheSurface) {
  const Built built = bumped(make_diffuse(Rgb(1)), {5, 4}, {});
  for (int i = 0; i < 5000; ++i) {
    Rng rng(40, Stream::test, 0, static_cast<std::uint64_t>(i));
    const Vec3 wo = sample_sphere(rng.uniform2());
    const Carried carried = rng.uniform() < 0.5f ? Carried::flux : Carried::radiance;
    const float u_lobe = rng.uniform();
    const auto s =
        built.bsdf->sample(flat_point(), wo, u_lobe, rng.uniform2(), Lobes::all, carried);
    EXPECT_TRUE(!s || (wo.z > 0 && s->wi.z > 0));
    const Vec3 wi = sample_sphere(rng.uniform2());
    if (wo.z * wi.z > 0) continue;
    EXPECT_EQ(built.bsdf->f(flat_point(), wo, wi, Lobes::all, carried), Rgb(0));
  }
}

TEST(TiltedBsdf, WhiteOneReflectsNoMoreThanItReceives) {
  for (const Vec2 slope : {Vec2{0.5f, 0}, Vec2{3, -2}}) {
    const Built built = bumped(make_diffuse(Rgb(1)), slope, {});
    for (const Vec3 wo : views(false)) {
      Running sum;
      for (int i = 0; i < 20000; ++i) {
        Rng rng(41, Stream::test, 0, static_cast<std::uint64_t>(i));
        const float u_lobe = rng.uniform();
        const auto s = built.bsdf->sample(flat_point(), wo, u_lobe, rng.uniform2(), Lobes::all,
                                          Carried::radiance);
        sum.add(s ? static_cast<double>(s->weight.g) : 0);
      }
      EXPECT_LE(sum.mean(), 1 + 1e-5);
      EXPECT_GT(sum.mean(), 0.1);
    }
  }
}

/// Photons' mean weight times `g(wi)`, and the integral of the eye path's f, seen from wi, over wi.
void expect_adjoint(const Bsdf& bsdf, Vec3 wo, double alpha) {
  const auto g = [](Vec3 wi) { return 1 + wi.x + 0.5f * wi.y; };
  Running photons, eyes;
  for (int i = 0; i < 60000; ++i) {
    Rng rng(42, Stream::test, 0, static_cast<std::uint64_t>(i));
    const float u_lobe = rng.uniform();
    const auto s = bsdf.sample(flat_point(), wo, u_lobe, rng.uniform2(), Lobes::all, Carried::flux);
    photons.add(s ? static_cast<double>(s->weight.g * g(s->wi)) : 0);
    const Vec3 wi = sample_cosine_hemisphere(rng.uniform2());
    const Rgb f = bsdf.f(flat_point(), wi, wo, Lobes::all, Carried::radiance);
    eyes.add(static_cast<double>(f.g * kPi * g(wi)));
  }
  if (photons.mean() == 0 && eyes.mean() == 0) return;  // light from behind the tilted normal
  const double variance = photons.variance_of_mean() + eyes.variance_of_mean();
  EXPECT_GT(z_test_p((photons.mean() - eyes.mean()) / std::sqrt(variance)), alpha)
      << wo.z << " " << photons.mean() << " " << eyes.mean();
}

TEST(TiltedBsdf, PhotonsAreScatteredByTheAdjointWhateverIsRepaired) {
  const double alpha = sidak(kAlpha, 2 * 4 * 3);
  for (const bool rough : {false, true}) {
    for (const TiltRepairs repairs : {TiltRepairs{false, false}, TiltRepairs{true, false},
                                      TiltRepairs{false, true}, TiltRepairs{true, true}}) {
      auto inner = rough ? make_rough_conductor({{}, {MicrofacetKind::ggx, 0.5f, 0.5f}})
                         : make_diffuse(Rgb(0.8f));
      const Built built = bumped(std::move(inner), {2, 1}, repairs);
      for (const Vec3 wo : views(false)) expect_adjoint(*built.bsdf, wo, alpha);
    }
  }
}

TEST(FluxDensity, IsWeighedByTheRatioOfCosines) {
  SurfacePoint at = flat_point();
  at.ns = normalize({0.3f, 0.1f, 1});
  const auto bsdf = make_diffuse(Rgb(0.5f));
  const Scattering seen(at, *bsdf, {0, 0, 1}, Carried::radiance);
  const Vec3 wi = normalize({0.4f, -0.2f, 0.7f});
  // Irradiance by the geometric normal is radiance |wi.ng| d omega; the eye path wants |wi.ns|.
  EXPECT_FLOAT_EQ(seen.f_flux(wi, Lobes::all).r * dot(wi, at.ng), seen.f_cos(wi, Lobes::all).r);
  EXPECT_FALSE(seen.lambertian());
}

/// Even light from everywhere: photons arrive by the cosine to the geometric normal, and together
/// bring (1 + cos t) / 2 of what an untilted surface sends back, less what cutting the ratio loses.
TEST(FluxDensity, OfEvenLightIsRightAndNoPhotonStandsOut) {
  constexpr int kPhotons = 100'000;
  const auto white = make_diffuse(Rgb(1));
  for (const float tilt : {0.1f, 0.3f, 0.5f}) {
    SurfacePoint at = flat_point();
    at.ns = {std::sin(tilt), 0, std::cos(tilt)};
    const Scattering seen(at, *white, {0, 0, 1}, Carried::radiance);
    Running sum;
    float most = 0;
    for (std::uint64_t i = 0; i < kPhotons; ++i) {
      Rng rng(12, Stream::test, 0, i);
      const float share = seen.f_flux(sample_cosine_hemisphere(rng.uniform2()), Lobes::all).g * kPi;
      sum.add(static_cast<double>(share));
      most = std::max(most, share);
    }
    const double right = (1 + std::cos(static_cast<double>(tilt))) / 2;
    const double loss = static_cast<double>(tilt * tilt) / 28;
    EXPECT_NEAR(sum.mean(), right - loss / 2, loss / 2 + 4 * sum.standard_error()) << tilt;
    EXPECT_LE(most, 8.001f);
    EXPECT_GT(most, 4) << tilt;  // so much is not cut
  }
}

}  // namespace
}  // namespace octolux
