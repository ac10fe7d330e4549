// Kernels that know photons alone, told which of them the query sees: nothing from behind a wall,
// everything of an open or curved surface.
#include "estimators/seen_photons.h"

#include <gtest/gtest.h>

#include "tests/estimators/geometry_kernels.h"

namespace octolux::test {
namespace {

constexpr const char* kBlindKernels[] = {"disc", "cone", "octobox", "hull"};

std::unique_ptr<Estimator> kernel(const char* name, bool seen, bool correction = true,
                                  int neighbours = 20) {
  EstimatorConfig config;
  config.kernel = name;
  config.neighbours = neighbours;
  config.correction = correction;
  config.seen = seen;
  return make_estimator(config);
}

TEST(SeenPhotons, NoneFromBehindAWallAtAnyScale) {
  for (const auto& [scale, shift] : {std::pair{1e-4f, 0.0f}, {1.0f, 0.0f}, {1e4f, 1e5f}}) {
    Placement placement;
    placement.scale = scale;
    placement.shift = {shift, -shift, shift};
    Room room(placement);
    room.floor(-20, -20, 20, 20);
    room.wall({-20, 0}, {20, 0});
    Rng rng = rng_of(41);
    const PhotonMap map =
        floor_photons(room, rng, 8000, 4, [](Vec2 p) { return p.y < 0 ? 1.0f : 0.0f; });
    for (const char* name : kBlindKernels) {
      for (int i = 0; i < 200; ++i) {
        const FloorLookUp look(room, {rng.uniform() - 0.5f, 0.002f + 0.2f * rng.uniform()});
        EXPECT_GT(look(*kernel(name, false), map, 0).count, 0) << name;
        EXPECT_EQ(look(*kernel(name, true), map, 0).count, 0) << name << ", scale " << scale;
      }
    }
  }
}

/// Estimates right beside a wall, four times as much light behind it, relative to the truth.
Running beside_a_wall(const char* name, int neighbours) {
  Room room;
  room.floor(-20, -20, 20, 20);
  room.wall({-20, 0}, {20, 0});
  const auto estimator = kernel(name, true, true, neighbours);
  const FloorLookUp look(room, {0.1f, 0.001f});
  Rng rng = rng_of(45);
  Running ratio;
  for (int i = 0; i < 600; ++i) {
    const PhotonMap map =
        floor_photons(room, rng, 2000, 2, [](Vec2 p) { return p.y < 0 ? 1.0f : 0.25f; });
    ratio.add(look(*estimator, map, 0).radiance.g / 0.25);
  }
  return ratio;
}

// A fifth of the photons is seen, on half of the disc. The boxes know, and are trusted earlier than
// on an open plane, where at twelve photons they would be 0.29 below the truth.
TEST(SeenPhotons, BoxesKnowHowMuchOfTheDiscAWallLeaves) {
  EXPECT_NEAR(beside_a_wall("disc", 100).mean(), 0.5, 0.05);
  for (const char* name : {"octobox", "hull"}) {
    const Running twenty = beside_a_wall(name, 100), twelve = beside_a_wall(name, 60);
    EXPECT_NEAR(twenty.mean(), 1, 0.04 + 4 * twenty.standard_error()) << name;
    EXPECT_GT(twelve.mean() - 3 * twelve.standard_error(), 0.71) << name;
  }
}

TEST(SeenPhotons, AllOnAnOpenFloor) {
  Room room;
  room.floor(-20, -20, 20, 20);
  Rng rng = rng_of(42);
  const PhotonMap map = floor_photons(room, rng, 8000, 4, [](Vec2) { return 1.0f; });
  for (const char* name : kBlindKernels) {
    const FloorLookUp look(room, {0.3f, 0.1f});
    EXPECT_EQ(look(*kernel(name, true), map, 0).radiance.g,
              look(*kernel(name, false), map, 0).radiance.g);
  }
}

TEST(SeenPhotons, PublishedFormsStayAsTheyAre) {
  Room room;
  room.floor(-20, -20, 20, 20);
  room.wall({-20, 0}, {20, 0});
  Rng rng = rng_of(43);
  const PhotonMap map = floor_photons(room, rng, 8000, 4, [](Vec2) { return 1.0f; });
  for (const char* name : kBlindKernels) {
    const FloorLookUp look(room, {0.3f, 0.05f});
    EXPECT_EQ(look(*kernel(name, true, false), map, 0).radiance.g,
              look(*kernel(name, false, false), map, 0).radiance.g);
  }
}

TEST(SeenPhotons, ACurvedSurfaceIsNoWall) {
  constexpr float kRadius = 0.8f;
  for (const int facets : {16, 64, 1024}) {
    for (const float bend : {1.0f, -1.0f}) {
      Room room;
      add_half_cylinder(room, facets, bend);
      Rng rng = rng_of(44);
      std::vector<Photon> photons;
      for (int i = 0; i < 400; ++i) {
        const Vec2 p{kRadius * (2 * rng.uniform() - 1), kRadius * (2 * rng.uniform() - 1)};
        Photon photon;
        const SurfacePoint on = room.look_down(p, 5).value();
        photon.position = on.position;
        photon.normal = photon.wi = on.ng.z < 0 ? -on.ng : on.ng;
        photon.flux = Rgb(1);
        photons.push_back(photon);
      }
      const PhotonMap map(std::move(photons));
      for (const char* name : kBlindKernels) {
        const FloorLookUp look(room, {0.01f, 0.02f});
        const Bandwidth bandwidth{.max_radius = kRadius};
        const int all = look(*kernel(name, false), map, 0, bandwidth).count;
        EXPECT_GT(all, 15);
        EXPECT_EQ(look(*kernel(name, true), map, 0, bandwidth).count, all)
            << name << ", " << facets << " facets, bend " << bend;
      }
    }
  }
}

}  // namespace
}  // namespace octolux::test
