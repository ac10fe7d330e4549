// Sectors of a region of the tangent plane, and the guess of how far photons reach.
#include "accel/photon_region.h"

#include <gtest/gtest.h>

#include "accel/photon_map.h"
#include "core/rng.h"

namespace octolux {
namespace {

TEST(PhotonRegion, SectorsAreNumberedByAngle) {
  for (int i = 0; i < 360; ++i) {
    const float angle = (static_cast<float>(i) + 0.5f) * (kPi / 180);
    EXPECT_EQ(PhotonRegion::sector_of({std::cos(angle), std::sin(angle)}), i / 45) << i;
  }
}

TEST(PhotonRegion, HoldsThePlaneUntilLinesAreSet) {
  PhotonRegion region;
  region.s = {0, 1, 0};
  region.t = {-1, 0, 0};
  EXPECT_TRUE(region.contains(Vec3{1e30f, -1e30f, 5}));
  region.sectors[0].set(2, {{1, 0}, 0.5f});  // in the sector from y to -x
  EXPECT_TRUE(region.contains(Vec3{-0.1f, 0.4f, 7}));
  EXPECT_FALSE(region.contains(Vec3{-0.1f, 0.6f, 7}));
  EXPECT_TRUE(region.contains(Vec3{0.1f, 0.6f, 7}));
}

TEST(PhotonMap, GuessesDistancesOnAPlane) {
  constexpr int kPhotons = 20000;
  std::vector<Photon> photons(kPhotons);
  Rng rng(20060131, Stream::test, 7, 1);
  for (Photon& p : photons) {
    const Vec2 u = rng.uniform2();
    p.position = {u.x, u.y, 0};
    p.normal = p.wi = {0, 0, 1};
  }
  const PhotonMap map(photons);
  const float expected = std::sqrt(50 / (kPhotons * kPi));
  float sum = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec2 u = rng.uniform2();
    const float guess =
        map.rough_distance({0.1f + 0.8f * u.x, 0.1f + 0.8f * u.y, 0}, {0, 0, 1}, 50);
    EXPECT_TRUE(guess > expected / 3 && guess < expected * 3) << guess / expected;
    sum += guess / 200;
  }
  EXPECT_NEAR(sum / expected, 1, 0.2);  // it steers work, not results
  EXPECT_EQ(PhotonMap().rough_distance({0, 0, 0}, {0, 0, 1}, 50), kInfinity);
}

}  // namespace
}  // namespace octolux
