// The free region at walls, corners and edges: exact at every scale and offset, on either side of a
// wall through the query, and nothing leaks.
#include "estimators/free_region.h"

#include <gtest/gtest.h>

#include "estimators/sector_integral.h"
#include "tests/estimators/region_quality.h"

namespace octolux::test {
namespace {

/// Scale, rotation and offset under which everything must stay the same.
class FreeRegionPlaces : public testing::TestWithParam<Placement> {
 protected:
  Room room_{GetParam()};
  /// What rounding the vertices may add to the region: a few units in the last place, against h.
  double rounding() const {
    const Placement& p = GetParam();
    const double ulp = 0x1p-23 * max_component(abs(p.shift)) / p.scale;
    return kOnTheLine + 8 * ulp;
  }
};

TEST_P(FreeRegionPlaces, OpenPlaneIsWhole) {
  add_floor(room_);
  const Outcome out = outcome(room_, anywhere({-1, -1}, {1, 1}), [](Vec2) { return true; });
  EXPECT_NEAR(out.share, 1, 1e-9);
}

TEST_P(FreeRegionPlaces, WallIsExact) {
  add_floor(room_);
  room_.wall({-kFar, 0}, {kFar, 0});
  const Outcome out = outcome(room_, anywhere({0, 0.02f}, {1, 1.2f}), beyond_wall);
  EXPECT_LE(out.worst_excess, rounding());
  EXPECT_GT(out.share, 0.999 - rounding());
}

TEST_P(FreeRegionPlaces, CornerIsExact) {
  add_floor(room_);
  room_.walls({{0, kFar}, {0, 0}, {kFar, 0}}, false);
  const Outcome out = outcome(room_, anywhere({0.02f, 0.02f}, {1.2f, 1.2f}), in_corner);
  EXPECT_LE(out.worst_excess, rounding());
  EXPECT_GT(out.share, 0.98 - rounding());
}

TEST_P(FreeRegionPlaces, ReentrantCornerLeaksNothing) {
  add_floor(room_);
  room_.walls({{0, kFar}, {0, 0}, {kFar, 0}}, false);
  const Outcome out = outcome(room_, anywhere({-1, -1}, {1, 1}, around_pillar), around_pillar);
  EXPECT_LE(out.worst_excess, rounding());
  EXPECT_GT(out.share, 0.9);
}

TEST_P(FreeRegionPlaces, SheetEndsAtItsEdges) {
  room_.floor(-1, -1, 1, 1);
  const Outcome out = outcome(room_, anywhere({-0.98f, -0.98f}, {0.98f, 0.98f}), on_table);
  EXPECT_LE(out.worst_excess, rounding());
  EXPECT_GT(out.share, 0.95);
}

INSTANTIATE_TEST_SUITE_P(ScalesAndOffsets, FreeRegionPlaces,
                         testing::Values(Placement{1, 0, 0, {}}, Placement{1, 0.4f, 0.7f, {}},
                                         Placement{1e-4f, 0.4f, 0.7f, {}},
                                         Placement{1e4f, 0.4f, 0.7f, {}},
                                         Placement{1, 0, 0, {1e5f, -1e5f, 1e5f}},
                                         Placement{1, 0.4f, 0.7f, {1e5f, 1e5f, 0}},
                                         Placement{1e4f, 0.4f, 0.7f, {1e5f, 1e5f, 1e5f}},
                                         Placement{1e-4f, 0.4f, 0.7f, {10, 0, -10}}));

TEST(FreeRegion, FourFeelersKnowCornersToo) {
  Room room;
  add_floor(room);
  room.walls({{0, kFar}, {0, 0}, {kFar, 0}}, false);
  const Outcome out = outcome(room, anywhere({0.02f, 0.02f}, {1.2f, 1.2f}), in_corner, 1, 4);
  EXPECT_LE(out.worst_excess, kOnTheLine);
  EXPECT_GT(out.share, 0.95);
}

TEST(FreeRegion, AcuteAndObtuseCornersAreExact) {
  for (const float degrees : {30.0f, 45.0f, 60.0f, 100.0f, 135.0f, 170.0f}) {
    const float angle = degrees * (kPi / 180);
    const Vec2 side{std::cos(angle), std::sin(angle)};
    Room room;
    add_floor(room);
    room.walls({side * kFar, {0, 0}, {kFar, 0}}, false);
    const Truth free = [side](Vec2 p) { return p.y > 0 && cross(p, side) > 0; };
    const Outcome out = outcome(room, anywhere({-1, 0}, {1.5f, 1.5f}, free), free);
    EXPECT_LE(out.worst_excess, kOnTheLine) << degrees;
    EXPECT_GT(out.share, 0.95) << degrees;
  }
}

TEST(FreeRegion, EndsOfCorridorsAndShelvesAreSeen) {
  const Truth free = [](Vec2 p) { return p.x > 0 && p.x < 0.3f && p.y > 0; };
  Room corridor;
  add_floor(corridor);
  corridor.walls({{0, 0}, {0, kFar}, {0.3f, kFar}, {0.3f, 0}}, true);
  Room shelf;
  shelf.floor(0, 0, 0.3f, kFar);
  for (Room* room : {&corridor, &shelf}) {
    const Outcome out = outcome(*room, anywhere({0.01f, 0.01f}, {0.29f, 1.2f}), free);
    EXPECT_LE(out.worst_excess, 0.02);  // few samples are in the strip
    EXPECT_GT(out.share, 0.85);
  }
}

TEST(FreeRegion, ThinWallsOfAnyThicknessAndNone) {
  for (const float thickness : {0.0f, 0.001f, 0.01f, 0.1f}) {
    Room room({1, 0.3f, 0.2f, {}});
    add_floor(room);
    room.box(-kFar, -thickness, kFar, 0, 0, 3);
    const Outcome out = outcome(room, anywhere({0, 0.001f}, {1, 0.3f}), beyond_wall);
    EXPECT_LE(out.worst_excess, kOnTheLine) << thickness;
  }
}

TEST(FreeRegion, AtAWallTheViewerSaysOnWhichSide) {
  for (const float side : {1.0f, -1.0f}) {
    Room room({1, 0.3f, 0.2f, {}});
    add_floor(room);
    room.wall({-kFar, 0}, {kFar, 0});
    Rng rng = rng_of(2);
    for (int i = 0; i < 100; ++i) {
      const Vec2 x{rng.uniform(), 0};
      FeelerQuery query = moved_to(room, query_at(room, {0.1f, 0.5f}, 2.2f, rng.uniform()), x);
      query.wo = room.placement().vector(normalize(Vec3{0.2f, 0.5f * side, 0.5f}));
      const Quality quality = judge(
          room, FreeRegion(room.caster(), query), x, 1, [side](Vec2 p) { return p.y * side > 0; },
          kSamples);
      EXPECT_LE(quality.excess, kOnTheLine);
      EXPECT_GT(quality.share, 0.99);
    }
  }
}

TEST(FreeRegion, ExactlyInACorner) {
  Room room({1, 0.3f, 0.2f, {}});
  add_floor(room);
  room.walls({{0, kFar}, {0, 0}, {kFar, 0}}, false);
  Rng rng = rng_of(3);
  for (int i = 0; i < 100; ++i) {
    FeelerQuery query = moved_to(room, query_at(room, {0.5f, 0.5f}, 2.2f, rng.uniform()), {0, 0});
    query.wo = room.placement().vector(normalize(Vec3{0.3f, 0.4f, 0.5f}));
    const Quality quality =
        judge(room, FreeRegion(room.caster(), query), {0, 0}, 1, in_corner, kSamples);
    EXPECT_LE(quality.excess, 2 * kOnTheLine);
    EXPECT_GT(quality.share, 0.95);
  }
}

TEST(FreeRegion, ExactlyOnAFreeEdge) {
  Room room({1, 0.3f, 0.2f, {}});
  room.floor(-kFar, -kFar, kFar, 0);
  Rng rng = rng_of(4);
  for (int i = 0; i < 100; ++i) {
    const FeelerQuery query =
        moved_to(room, query_at(room, {-0.2f, -0.1f}, 2.2f, rng.uniform()), {-0.2f, 0});
    const Quality quality = judge(
        room, FreeRegion(room.caster(), query), {-0.2f, 0}, 1, [](Vec2 p) { return p.y < 0; },
        kSamples);
    EXPECT_LE(quality.excess, kOnTheLine);
    EXPECT_GT(quality.share, 0.95);
  }
}

TEST(FreeRegion, IntegralOfTheTaper) {
  const FreeRegion whole(Vec3{0, 0, 1});
  EXPECT_NEAR(whole.integral(2, 0), 4 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(whole.integral(2, 1), 2 * std::numbers::pi, 1e-12);
  // The half disc beyond a line at distance c: area by the segment formula, d^2 by quadrature.
  PhotonRegion::Sector sector;
  sector.set(0, {{1, 0}, 0.5f});
  double expected = 0, tapered = 0;
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = (i + 0.5) / kSteps * std::numbers::pi / 4;
    const double r = std::min(1.0, 0.5 / std::cos(angle));
    expected += r * r / 2 * std::numbers::pi / 4 / kSteps;
    tapered += (r * r / 2 - r * r * r * r / 4) * std::numbers::pi / 4 / kSteps;
  }
  EXPECT_NEAR(sector_integral(sector, 0, 1, 0), expected, 1e-9);
  EXPECT_NEAR(sector_integral(sector, 0, 1, 1), tapered, 1e-9);
}

/// A closed room of five corners (one obtuse, none regular), and what lies behind its walls.
const std::vector<Vec2> kRoom{{0, 0}, {3, 0}, {4, 2}, {3.5f, 4}, {1, 4}, {0, 3}};

/// Signed distance inwards from the nearest wall's line.
float depth(Vec2 p) {
  float least = kInfinity;
  for (std::size_t i = 0; i < kRoom.size(); ++i) {
    const Vec2 a = kRoom[i], way = kRoom[(i + 1) % kRoom.size()] - a;
    least = std::min(least, cross(way, p - a) / length(way));
  }
  return least;
}

/// Photons all around a room with thin walls; those behind must not count.
int count_leaks(Room& room, int queries) {
  constexpr float kRounding = 1e-5f;
  const Place inside = anywhere({0, 0}, {4, 4}, [](Vec2 p) { return depth(p) > kRounding; });
  Rng rng = rng_of(7);
  int leaks = 0, behind = 0;
  for (int i = 0; i < queries; ++i) {
    const Vec2 x = inside(rng);
    const float h = 0.05f * std::pow(40.0f, rng.uniform());
    const FeelerQuery query = query_at(room, x, 1.1f * h, rng.uniform());
    const FreeRegion region(room.caster(), query);
    for (int j = 0; j < 8; ++j) {
      const float radius = h * std::sqrt(rng.uniform());
      const float angle = 2 * kPi * rng.uniform();
      const Vec2 p = x + Vec2{radius * std::cos(angle), radius * std::sin(angle)};
      if (depth(p) > -kRounding) continue;
      const Vec3 offset = room.placement().point({p.x, p.y, 0}) - query.point.position;
      leaks += region.photons().contains(offset);
      ++behind;
    }
  }
  EXPECT_GT(behind, queries / 2);
  return leaks;
}

void expect_no_leaks(int queries) {
  for (const float thickness : {0.0f, 0.001f, 0.1f}) {
    Room room({1, 0.4f, 0.3f, {}});
    add_floor(room);
    room.walls(kRoom, true);
    std::vector<Vec2> outside;
    for (const Vec2 p : kRoom) outside.push_back(p + (p - Vec2{2, 2}) * thickness);
    if (thickness > 0) room.walls(outside, true);
    EXPECT_EQ(count_leaks(room, queries / 3), 0) << "wall of " << thickness;
  }
}

TEST(FreeRegion, NothingLeaksThroughWalls) { expect_no_leaks(20000); }
TEST(FreeRegionSlow, NothingLeaksThroughWalls) { expect_no_leaks(1000000); }

}  // namespace
}  // namespace octolux::test
