// What a point is said to see without a ray: nothing behind a wall, all of an open or curved
// surface, and in front of a wall nearly everything.
#include "estimators/clearing.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "tests/estimators/rooms.h"

namespace octolux::test {
namespace {

SurfacePoint floor_point(Room& room, Vec2 p) {
  SurfacePoint point = room.look_down(p).value();
  if (dot(point.ng, room.placement().vector({0, 0, 1})) < 0) point.ng = -point.ng;
  return point;
}

Clearing clearing_around(Room& room, const SurfacePoint& point, float reach) {
  const FeelerQuery query{.point = point, .normal = point.ng, .wo = point.ng, .length = reach};
  return {room.caster(), query, TangentPlane(query)};
}

bool contains(const Clearing& clearing, const SurfacePoint& from, Vec3 across, float reach) {
  const Vec3 p = Frame::from_normal(from.ng).to_local(across);
  return clearing.contains({p.x, p.y}, reach);
}

Vec2 in_disc(Rng& rng) { return sample_disk(rng.uniform2()); }

TEST(Clearing, EndsAtWallsOfAnyAngleAtAnyScale) {
  Rng rng = rng_of(51);
  for (int i = 0; i < 600; ++i) {
    Placement placement;
    if (i % 3 == 1) placement.scale = 1e-4f;
    if (i % 3 == 2) placement.scale = 1e4f, placement.shift = {1e5f, -1e5f, 1e5f};
    placement.turn = 6 * rng.uniform();
    Room room(placement);
    const float distance = 0.02f + 1.2f * rng.uniform();
    room.floor(-20, -20, 20, 20);
    room.wall({-20, distance}, {20, distance});
    const SurfacePoint point = floor_point(room, {0, 0});
    const Clearing clearing = clearing_around(room, point, placement.scale);
    EXPECT_FALSE(clearing.whole() && distance < 0.99f);
    for (int k = 0; k < 100; ++k) {
      const Vec2 p = in_disc(rng);
      const Vec3 across = placement.vector({p.x, p.y, 0}) * placement.scale;
      const bool contained = contains(clearing, point, across, placement.scale);
      const bool behind = p.y > distance, near = length(p) < 0.9f * distance - 0.01f;
      EXPECT_FALSE(contained && behind) << distance << ' ' << p.x << ' ' << p.y;
      EXPECT_TRUE(contained || !near) << distance << ' ' << p.x << ' ' << p.y;
    }
  }
}

TEST(Clearing, ReachesAllOfAnOpenFloor) {
  Room room;
  room.floor(-20, -20, 20, 20);
  const SurfacePoint point = floor_point(room, {0.3f, 0.1f});
  const Clearing clearing = clearing_around(room, point, 0.5f);
  EXPECT_TRUE(clearing.whole());
  Rng rng = rng_of(52);
  for (int k = 0; k < 1000; ++k) {
    const Vec2 p = in_disc(rng) * 0.5f;
    EXPECT_TRUE(contains(clearing, point, {p.x, p.y, 0}, 0.5f));
  }
}

TEST(Clearing, ACurvedSurfaceIsNoWall) {
  Rng rng = rng_of(53);
  for (const int facets : {16, 64, 1024}) {
    for (const float bend : {1.0f, -1.0f}) {
      Room room;
      add_half_cylinder(room, facets, bend);
      const SurfacePoint point = floor_point(room, {0.01f, 0.02f});
      const Clearing clearing = clearing_around(room, point, 0.8f);
      for (int k = 0; k < 200; ++k) {
        const Vec2 p = in_disc(rng) * 0.7f;
        EXPECT_TRUE(contains(clearing, point, {p.x, p.y, 0}, 0.8f)) << facets << ' ' << bend;
      }
    }
  }
}

}  // namespace
}  // namespace octolux::test
