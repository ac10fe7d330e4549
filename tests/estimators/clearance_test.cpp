// What free_distance() says against rays sent into the same scenes, in every direction.
#include "estimators/clearance.h"

#include <gtest/gtest.h>

#include "core/constants.h"
#include "tests/estimators/rooms.h"

namespace octolux {
namespace {

using test::Placement;
using test::query_at;
using test::rng_of;
using test::Room;

/// A floor of 4 x 4 with a few boxes, a wall without thickness, a board above and a step below.
void furnish(Room& room, std::uint64_t seed) {
  Rng rng = rng_of(40, seed);
  room.floor(-2, -2, 2, 2);
  for (int i = 0; i < 3; ++i) {
    const Vec2 u = rng.uniform2();
    const Vec2 size = rng.uniform2();
    const float x = 3 * u.x - 1.8f, y = 3 * u.y - 1.8f;
    room.box(x, y, x + 0.1f + 0.4f * size.x, y + 0.1f + 0.4f * size.y, 0, 0.5f);
  }
  const Vec2 p = rng.uniform2(), q = rng.uniform2();
  room.wall(p * 4 - Vec2{2, 2}, q * 4 - Vec2{2, 2}, 0, 1);
  room.floor(-2.5f, -2.5f, 2.5f, 2.5f, -0.2f);
  room.floor(-1, -1, 1, 1, 2);
}

/// Do rays from just above the surface, and probes down to it, agree that nothing is near?
bool rays_agree(const RayCaster& caster, const FeelerQuery& query, float distance) {
  constexpr int kRays = 90;
  const TangentPlane plane(query);
  for (int i = 0; i < kRays; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / kRays;
    const Vec2 d{std::cos(angle), std::sin(angle)};
    if (caster.occluded({plane.point({0, 0}, plane.lift), plane.direction(d), 0, distance})) {
      return false;
    }
    const Ray probe{plane.point(d * (0.999f * distance), plane.lift), -plane.n, 0, 2 * plane.lift};
    if (query.edges && !caster.occluded(probe)) return false;
  }
  return true;
}

TEST(Clearance, IsNeverClaimedWhereRaysMeetSomething) {
  int clear = 0, queries = 0, rays_clear = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const float scale = seed % 3 == 0 ? 1e-4f : seed % 3 == 1 ? 1 : 1e4f;
    Room room({scale, 0.1f * static_cast<float>(seed), 0.3f, Vec3{1, 2, 3} * scale});
    furnish(room, seed);
    Rng rng = rng_of(41, seed);
    for (int i = 0; i < 50; ++i) {
      const Vec2 u = rng.uniform2();
      const float distance = 0.4f * rng.uniform();
      FeelerQuery query = query_at(room, u * 3.8f - Vec2{1.9f, 1.9f}, distance, 0, 1.5f);
      query.edges = i % 2 == 0;
      ++queries;
      rays_clear += rays_agree(room.caster(), query, query.length) ? 1 : 0;
      const float free = free_distance(room.caster(), query, query.length, 0);
      EXPECT_LE(free, query.length);
      clear += free == query.length ? 1 : 0;
      EXPECT_TRUE(free == 0 || rays_agree(room.caster(), query, free))
          << "seed " << seed << " query " << i;
    }
  }
  EXPECT_LT(rays_clear, queries * 9 / 10);
  EXPECT_GT(clear, rays_clear * 8 / 10);  // and it is claimed mostly where it is true
}

TEST(Clearance, EndsAtEdgesButNotAtDiagonals) {
  Room room;
  room.floor(-1, -1, 1, 1);
  FeelerQuery query = query_at(room, {0.3f, 0.31f}, 0.5f, 0);  // the diagonal is 0.007 away
  EXPECT_NEAR(free_distance(room.caster(), query, 1, 0), 0.69f, 1e-4f);
  query.edges = false;
  EXPECT_EQ(free_distance(room.caster(), query, 10, 0), 10);
}

TEST(Clearance, SidesOfOneWallAreNotEachOthers) {
  // Two floors back to back are no surface going on beyond the first one's edge.
  Room room;
  room.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  room.quad({-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0});
  const FeelerQuery query = query_at(room, {0.6f, 0}, 0.5f, 0);
  EXPECT_LE(free_distance(room.caster(), query, 0.45f, 0), 0.401f);
}

TEST(Clearance, OnlyWhatReachesTheFeelersCounts) {
  Room room;
  room.floor(-2, -2, 2, 2);
  room.floor(0.1f, -1, 1, 1, 0.01f);    // a lamp 1 cm before the ceiling
  room.floor(-1, -1, -0.1f, 1, -0.1f);  // something behind
  EXPECT_EQ(free_distance(room.caster(), query_at(room, {0.01f, 0}, 0.5f, 0), 0.5f, 0), 0.5f);
  Room wall;
  wall.floor(-2, -2, 2, 2);
  wall.wall({0.2f, -2}, {0.2f, 2});
  const FeelerQuery query = query_at(wall, {0.01f, 0}, 0.5f, 0);
  EXPECT_NEAR(free_distance(wall.caster(), query, 0.5f, 0), 0.19f, 1e-4f);
  EXPECT_EQ(free_distance(wall.caster(), query, 0.5f, 0.2f), 0);
}

// The floor's triangle that is shown after the wall's once made the wall forgotten, and light
// leaked through walls without thickness. Few triangles come together, in the order of the mesh.
TEST(Clearance, WhatWasMetStaysMet) {
  for (const bool wall_first : {true, false}) {
    Room room;
    if (wall_first) room.wall({0.2f, -2}, {0.2f, 2});
    room.floor(-1, -1, 1, 1);
    if (!wall_first) room.wall({0.2f, -2}, {0.2f, 2});
    for (int i = 0; i < 20; ++i) {
      const float x = 0.19f - 0.02f * static_cast<float>(i);
      const FeelerQuery query = query_at(room, {x, 0.013f}, 0.5f, 0);
      EXPECT_NEAR(free_distance(room.caster(), query, 0.5f, 0), 0.2f - x, 1e-4f);
    }
  }
}

TEST(Clearance, ManyTrianglesAreLeftToTheFeelers) {
  Room room;
  for (int i = 0; i < 100; ++i) {
    const float z = -0.001f * static_cast<float>(i);
    room.floor(-1, -1, 1, 1, z);
  }
  EXPECT_EQ(free_distance(room.caster(), query_at(room, {0.1f, 0}, 0.3f, 0), 0.3f, 0), 0);
}

// Of a quadric its bounds count, also where an instance places it.
TEST(Clearance, EndsAtBoundsOfQuadrics) {
  Room room;
  room.floor(-2, -2, 2, 2);
  room.add(Quadric{});
  const FeelerQuery beside = query_at(room, {1.2f, 0}, 0.5f, 0);
  EXPECT_NEAR(free_distance(room.caster(), beside, 0.5f, 0), 0.2f, 1e-4f);
  const FeelerQuery far = query_at(room, {1.6f, 1.5f}, 0.3f, 0);
  EXPECT_EQ(free_distance(room.caster(), far, 0.3f, 0), 0.3f);
}

}  // namespace
}  // namespace octolux
