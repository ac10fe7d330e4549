// renderer/photon_pass.h: photons know whether a smooth lobe scattered them, and how far off.
// Gather rays look for the light of those only; what came through a pane or through glass is found
// by other means.
#include "renderer/photon_pass.h"

#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

constexpr std::int64_t kPaths = 1 << 16;

std::vector<Photon> photons_of(const Scene& scene, PhotonKind kind) {
  const LightSampler lights(scene);
  return trace_photons(scene, lights, kind, kPaths, {1, 0}).photons;
}

/// How many photons of a path length are scattered, and how many are not.
struct Counts {
  int scattered = 0, straight = 0;
};
Counts count(const std::vector<Photon>& photons, int segments) {
  Counts counts;
  for (const Photon& p : photons) {
    if (p.segments == segments) ++(scattered(p) ? counts.scattered : counts.straight);
  }
  return counts;
}

TEST(TracePhotons, APaneScattersNothing) {
  // The wall is met through the pane first, and by what wall and pane reflect from then on.
  const std::vector<Photon> photons =
      photons_of(*shipped_scene("glass-pane/glass-pane.xml"), PhotonKind::global);
  const Counts first = count(photons, 2);
  EXPECT_EQ(first.scattered, 0);
  EXPECT_GT(first.straight, 20);
}

TEST(TracePhotons, GlassScattersNothingAndWallsDo) {
  const auto scene = shipped_scene("glass-sphere/glass-sphere.xml");
  const std::vector<Photon> caustics = photons_of(*scene, PhotonKind::caustic);
  EXPECT_GT(caustics.size(), 100u);
  for (const Photon& p : caustics) EXPECT_FALSE(scattered(p));

  const std::vector<Photon> all = photons_of(*scene, PhotonKind::global);
  EXPECT_EQ(count(all, 1).scattered, 0);
  EXPECT_GT(count(all, 1).straight, 1000);
  // Into the ball and out of it again, or from a wall and another.
  EXPECT_GT(count(all, 3).scattered, 1000);
  EXPECT_GT(count(all, 3).straight, 100);
}

/// A room whose ceiling lets the sun in through a hole; a mirror lies on its floor.
TEST(TracePhotons, OfANarrowLightOnlyWhatDoesNotArriveStraight) {
  const auto scene =
      scene_from("<scene version='3.0.0'>" + sensor_xml("0, 1, 3", "0, 1, 0", 40, 8, 8) + R"(
    <shape type='rectangle'><transform name='to_world'><scale value='4'/>
      <rotate x='1' angle='-90'/></transform></shape>
    <shape type='rectangle'><transform name='to_world'><scale value='0.5'/>
      <rotate x='1' angle='-90'/><translate y='0.01'/></transform>
      <bsdf type='conductor'><string name='material' value='none'/></bsdf></shape>
    <shape type='rectangle'><transform name='to_world'><scale value='4'/>
      <rotate x='1' angle='90'/><translate x='4.5' y='3'/></transform></shape>
    <emitter type='directional'><vector name='direction' x='1' y='-4' z='0'/></emitter></scene>)");
  const LightSampler lights(*scene);
  const auto stored = [&](bool all) {
    const PhotonSource source{lights, EmissionDensity(), all};
    return trace_photons(*scene, source, PhotonKind::global, kPaths, {1, 0}).photons;
  };
  std::vector<Photon> rest;
  int straight = 0, reflected = 0;
  for (const Photon& p : stored(true)) {
    if (p.segments > 1) rest.push_back(p);
    straight += p.segments == 1;
    reflected += p.segments == 2 && !scattered(p);
  }
  EXPECT_GT(straight, 1000);
  EXPECT_GT(reflected, 100);
  const std::vector<Photon> kept = stored(false);
  ASSERT_EQ(kept.size(), rest.size());
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(kept[i].position, rest[i].position);
}

TEST(TracePhotons, KnowHowFarTheyFlewFromTheSurfaceThatScatteredThem) {
  // A closed room of 4 m: photons come from its walls, none of which reaches into it.
  const auto scene =
      scene_from("<scene version='3.0.0'>" + sensor_xml("-1.9, 2, 0", "2, 2, 0", 40, 8, 8) +
                 closed_room_xml(0.6) + R"(
    <emitter type='point'><rgb name='intensity' value='10'/>
      <point name='position' x='0' y='1' z='0'/></emitter></scene>)");
  int told = 0;
  for (const Photon& p : photons_of(*scene, PhotonKind::global)) {
    EXPECT_EQ(scattered(p), p.segments > 1);
    if (!scattered(p)) continue;
    ++told;
    const Vec3 from = abs(p.position + p.wi * p.flown - scene->bounds.center());
    EXPECT_NEAR(std::max({from.x, from.y, from.z}), 2, 1e-4);
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(told, 1000);
}

}  // namespace
}  // namespace octolux::test
