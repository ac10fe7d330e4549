// renderer/light_origins.h: lobes point to where light came from, from wherever that is seen, and
// tell what is small from what surrounds it.
#include "renderer/light_origins.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "core/sampling.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

/// Of 500 photons: a tenth from a square of 0.2 m at (x, y, 4), the others from a ceiling of 8 m.
std::vector<LightOrigins::Photon> hatch(float x, float y, float scale = 1, Vec3 offset = {}) {
  std::vector<LightOrigins::Photon> photons;
  for (std::uint64_t i = 0; i < 500; ++i) {
    Rng rng(3, Stream::test, 21, i);
    const Vec2 u = rng.uniform2();
    const bool lamp = i % 10 == 0;
    const Vec3 origin = lamp ? Vec3{x + 0.2f * (u.x - 0.5f), y + 0.2f * (u.y - 0.5f), 4}
                             : Vec3{8 * u.x - 4, 8 * u.y - 4, 4};
    photons.push_back({origin * scale + offset, 1});
  }
  return photons;
}

/// Share of the samples at `point` that hit the square around (x, y, 4) of side 0.3 m.
double share_at(const LobeMixture& lobes, Vec3 point, float x, float y, float scale = 1,
                Vec3 offset = {}) {
  int hits = 0;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    Rng rng(4, Stream::test, 21, static_cast<std::uint64_t>(i));
    const Vec3 w = lobes.sample(rng.uniform2());
    if (!(w.z > 0)) continue;
    const Vec3 p = (point - offset) / scale;
    const Vec3 there = p + w * ((4 - p.z) / w.z);
    if (std::abs(there.x - x) < 0.15f && std::abs(there.y - y) < 0.15f) ++hits;
  }
  return static_cast<double>(hits) / kSamples;
}

TEST(LightOrigins, FindASmallLampWhereverItIsSeenFrom) {
  const LightOrigins origins(hatch(1, 0.5f), {0, 0, 0});
  // A tenth of the light; half of a lobe lies within its width, the rest in its tail. Directions
  // from the middle would miss the lamp by as much as the point is beside it.
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{-1, -1, 0}, Vec3{0, 2, 1}}) {
    EXPECT_GT(share_at(origins.seen_from(p), p, 1, 0.5f), 0.035) << p.x << ' ' << p.y;
  }
}

TEST(LightOrigins, DoNotDependOnScaleAndPlace) {
  const double plain =
      share_at(LightOrigins(hatch(1, 0.5f), {0, 0, 0}).seen_from({1, 0, 0}), {1, 0, 0}, 1, 0.5f);
  for (const float scale : {1e-4f, 1e4f}) {
    const Vec3 p{scale, 0, 0};
    const LightOrigins origins(hatch(1, 0.5f, scale), {0, 0, 0});
    EXPECT_NEAR(share_at(origins.seen_from(p), p, 1, 0.5f, scale), plain, 0.01) << scale;
  }
  const Vec3 far{1e5f, -1e5f, 1e5f}, p = far + Vec3{1, 0, 0};
  const LightOrigins origins(hatch(1, 0.5f, 1, far), far);
  EXPECT_NEAR(share_at(origins.seen_from(p), p, 1, 0.5f, 1, far), plain, 0.02);
}

TEST(LightOrigins, AreLobesOfAllTheLight) {
  constexpr Vec3 kCenter{0, 0, 0};
  EXPECT_TRUE(LightOrigins().seen_from(kCenter).empty());
  EXPECT_TRUE(LightOrigins({}, kCenter).seen_from(kCenter).empty());
  // Photons that have flown no way have no direction.
  const std::vector<LightOrigins::Photon> nowhere(20, {kCenter, 1});
  EXPECT_TRUE(LightOrigins(nowhere, kCenter).seen_from(kCenter).empty());

  const std::vector<LightOrigins::Photon> one{{{0, 0, 3}, 2}};
  const std::vector<LightOrigins::Photon> same(100, {{0, 0, 3}, 2});
  for (const auto& photons : {one, same, hatch(1, 1)}) {
    const LightOrigins origins(photons, kCenter);
    // At the place of the light itself, too, where it has no direction.
    for (const Vec3 p : {kCenter, Vec3{0.5f, 0, 0}, Vec3{0, 0, 3}}) {
      const LobeMixture lobes = origins.seen_from(p);
      Running ratio;  // of a density to the sphere's, over the sphere's samples: 1 in the mean
      for (int i = 0; i < 200'000; ++i) {
        Rng rng(6, Stream::test, 21, static_cast<std::uint64_t>(i));
        const Vec3 w = lobes.sample(rng.uniform2());
        ASSERT_TRUE(is_finite(w));
        ASSERT_GT(lobes.pdf_w(w), 0);
        ratio.add(1 / (4 * kPi * lobes.pdf_w(w)));
      }
      EXPECT_GT(z_test_p(ratio.z(1)), sidak(kAlpha, 9));
    }
  }
}

TEST(LightOrigins, WeighByFlux) {
  std::vector<LightOrigins::Photon> photons;
  for (int i = 0; i < 100; ++i) {
    photons.push_back(
        {{i % 2 ? 2.0f : -2.0f, 0.01f * static_cast<float>(i % 7), 2}, i % 2 ? 3.f : 1.f});
  }
  const LobeMixture lobes = LightOrigins(photons, {0, 0, 0}).seen_from({0, 0, 0});
  int right = 0;
  constexpr int kSamples = 40'000;
  for (int i = 0; i < kSamples; ++i) {
    Rng rng(5, Stream::test, 21, static_cast<std::uint64_t>(i));
    right += lobes.sample(rng.uniform2()).x > 0;
  }
  EXPECT_NEAR(right, 0.75 * kSamples, 6 * std::sqrt(0.75 * 0.25 * kSamples));
}

}  // namespace
}  // namespace octolux::test
