// Bsdf::coated_base: what pixels share under a coat is right if the base is a product of what
// either direction has, and part of the smooth lobes.
#include <gtest/gtest.h>

#include "core/constants.h"
#include "core/scattering.h"
#include "tests/core/bsdf_testing.h"

namespace octolux {
namespace {

using namespace test;

const SurfacePoint kPoint = test::flat_point();

TEST(CoatedBase, IsAProductWithinTheSmoothLobes) {
  const Color base(Rgb(0.2f, 0.5f, 0.8f));
  RoughPlasticConfig followed{{.diffuse_reflectance = base}}, gathered = followed;
  followed.alpha = 0.1f, gathered.alpha = 0.4f;
  const auto inner = make_rough_plastic(gathered);
  const std::unique_ptr<Bsdf> coats[] = {
      make_plastic({.diffuse_reflectance = base}), make_rough_plastic(followed),
      make_two_sided(*inner, *inner), make_glossy({base, Color(Rgb(0.3f)), 0.4f})};
  const Vec3 o = direction(0.9, 0), p = direction(0.3, 2), i = direction(0.7, 1),
             j = direction(0.2, 3);
  for (const auto& coat : coats) {
    const auto at = [&](Vec3 wo, Vec3 wi) { return coat->coated_base(kPoint, wo, wi).value(); };
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(at(o, i)[c] * at(p, j)[c] / (at(o, j)[c] * at(p, i)[c]), 1, 1e-5);
      EXPECT_LE(at(o, i)[c], coat->f(kPoint, o, i, Lobes::smooth, Carried::radiance)[c] * 1.00001f);
      EXPECT_GT(at(o, i)[c], 0);
    }
  }
  EXPECT_EQ(coats[1]->coated_base(kPoint, o, i),
            coats[1]->f(kPoint, o, i, Lobes::smooth, Carried::radiance));
  EXPECT_EQ(coats[2]->coated_base(kPoint, -o, -i), coats[2]->coated_base(kPoint, o, i));
  EXPECT_EQ(coats[0]->coated_base(kPoint, -o, i), Rgb(0));
  EXPECT_FALSE(make_plastic({.diffuse_reflectance = Rgb(0)})->coated_base(kPoint, o, i));
  EXPECT_FALSE(make_diffuse(base)->coated_base(kPoint, o, i));
}

/// Gloss is not shared: where it is strong the base's share is small, and without it whole.
TEST(CoatedBase, IsTheShareThatTheGlossLeaves) {
  const SurfacePoint at = kPoint;
  const Vec3 wo = direction(0.6, 0), mirrored = direction(0.6, kPi),
             elsewhere = direction(0.6, 0.1);
  RoughPlasticConfig config{{.diffuse_reflectance = Color(Rgb(0.2f, 0.5f, 0.8f))}};
  config.alpha = 0.25f;
  const auto gathered = make_rough_plastic(config);
  const Scattering seen(at, *gathered, wo, Carried::radiance);
  for (const Vec3 wi : {mirrored, elsewhere}) {
    const Rgb share = seen.coated_share(wi), all = seen.f(wi, Lobes::smooth);
    const Rgb base = gathered->coated_base(at, wo, wi).value();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c] * all[c], base[c], 1e-6);
  }
  EXPECT_LT(seen.coated_share(mirrored).r, 0.5f);
  EXPECT_GT(seen.coated_share(elsewhere).r, 0.9f);
  config.alpha = 0.1f;
  const auto followed = make_rough_plastic(config);
  EXPECT_EQ(Scattering(at, *followed, wo, Carried::radiance).coated_share(mirrored), Rgb(1));
}

}  // namespace
}  // namespace octolux
