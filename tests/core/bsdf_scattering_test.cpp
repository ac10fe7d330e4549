// Scattering: directions in world space, both normals, the adjoint, and sorting by kind.
#include <gtest/gtest.h>

#include "core/constants.h"
#include "core/scattering.h"
#include "tests/core/bsdf_testing.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

SurfacePoint tilted() {
  SurfacePoint at;
  at.ng = normalize({0.2f, 0.3f, 0.9f});
  at.ns = normalize({-0.1f, 0.5f, 0.8f});
  return at;
}

TEST(Scattering, BothNormalsMustAgree) {
  const auto inner = make_diffuse(Rgb(0.5f));
  const auto bsdf = make_two_sided(*inner, *inner);
  const SurfacePoint at = tilted();
  for (int i = 0; i < 2000; ++i) {
    Rng rng(9, Stream::test, 0, static_cast<std::uint64_t>(i));
    const Vec3 wo = direction(2 * rng.uniform() - 1, 2 * kPi * (i * 0.618));
    const Vec3 wi = direction(2 * rng.uniform() - 1, 2 * kPi * (i * 0.414));
    const Scattering s(at, *bsdf, wo, Carried::radiance);
    const bool same_side = dot(wo, at.ng) * dot(wi, at.ng) > 0;
    const bool consistent =
        dot(wo, at.ng) * dot(wo, at.ns) > 0 && dot(wi, at.ng) * dot(wi, at.ns) > 0;
    EXPECT_EQ(s.f(wi, Lobes::all), Rgb(same_side && consistent ? 0.5f * kInvPi : 0)) << i;
    EXPECT_GE(dot(s.facing_normal(), wo), 0);
  }
}

TEST(Scattering, PhotonsAreScatteredByTheAdjoint) {
  // Veach 1997, 5.3.2: f*(wo, wi) |wi.ng| |wo.ng| is symmetric with the eye path's f |cos| terms.
  const auto bsdf = make_diffuse(Rgb(0.5f));
  const SurfacePoint at = tilted();
  const Vec3 from_light = normalize({0.5f, 0.1f, 0.7f}), to_eye = normalize({-0.4f, 0.4f, 0.5f});
  const Scattering photon(at, *bsdf, from_light, Carried::flux);
  const Scattering eye(at, *bsdf, to_eye, Carried::radiance);
  // What an eye path carries: f |wi.ns|; a photon meets the surface with |wo.ng| and leaves with
  // its own |wi.ns|: the products with the geometric cosines must agree.
  const float by_eye = eye.f_cos(from_light, Lobes::all).r * std::abs(dot(to_eye, at.ng));
  const float by_photon = photon.f_cos(to_eye, Lobes::all).r * std::abs(dot(from_light, at.ng));
  EXPECT_FLOAT_EQ(by_eye, by_photon);
}

TEST(Scattering, SampleAgreesWithF) {
  const auto bsdf = make_rough_conductor({{}, {MicrofacetKind::ggx, 0.4f, 0.4f}});
  const SurfacePoint at = tilted();
  const Vec3 wo = normalize({0.1f, 0.3f, 0.9f});
  for (const Carried carried : {Carried::radiance, Carried::flux}) {
    const Scattering scattering(at, *bsdf, wo, carried);
    for (int i = 0; i < 200; ++i) {
      Rng rng(10, Stream::test, 0, static_cast<std::uint64_t>(i));
      const float u_lobe = rng.uniform();
      const auto s = scattering.sample(u_lobe, rng.uniform2(), Lobes::all);
      if (!s) continue;
      const float weight =
          scattering.f_cos(s->wi, Lobes::all).r / scattering.pdf_w(s->wi, Lobes::all);
      EXPECT_NEAR(weight / s->weight.r, 1, 1e-3);
    }
  }
}

}  // namespace
}  // namespace octolux
