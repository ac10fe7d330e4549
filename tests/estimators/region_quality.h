// How good a free region is, by sampling: against the truth of a scene built by rooms.h.
//
// Area of the region that is not free floor is the bias for constant irradiance where it is dark
// there, and a leak where it is lit; free floor that the region leaves out costs photons, never the
// mean.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "tests/estimators/rooms.h"

namespace octolux::test {

/// What a region is worth, against the truth. Shares of the region's area in the disc.
struct Quality {
  double excess = 0;    // in the region, but not free: the bias for constant irradiance, or a leak
  double share = 0;     // area of the region over the free area (star-shaped or not) of the disc
  double integral = 0;  // sampled area over FreeRegion::integral
};

/// Samples the disc of radius h (before the map) on a low-discrepancy set. `truth(p)`: is the floor
/// free at p?
template <class Truth>
Quality judge(const Room& room, const FreeRegion& region, Vec2 x, float h, const Truth& truth,
              int samples = 4000) {
  const Placement& map = room.placement();
  int in_region = 0, in_truth = 0, excess = 0;
  for (int i = 0; i < samples; ++i) {
    const double radius = h * std::sqrt((i + 0.5) / samples);
    const double angle = 2.399963229728653 * i;  // the golden angle
    const Vec2 d{static_cast<float>(radius * std::cos(angle)),
                 static_cast<float>(radius * std::sin(angle))};
    const bool inside = region.photons().contains(map.vector({d.x, d.y, 0}) * map.scale);
    const bool free = truth(x + d);
    in_region += inside;
    in_truth += free;
    excess += inside && !free;
  }
  const double disc = std::numbers::pi * h * h;
  const float scaled = h * map.scale;
  Quality quality;
  quality.excess = in_region ? static_cast<double>(excess) / in_region : 0;
  quality.share = in_truth ? static_cast<double>(in_region) / in_truth : 0;
  quality.integral = disc * in_region / samples /
                     (region.integral(scaled, 0) / (static_cast<double>(map.scale) * map.scale));
  return quality;
}

inline constexpr float kFar = 20;
inline constexpr int kQueries = 150;
inline constexpr int kSamples = 1000;
/// Samples that lie on a wall's line by construction may fall on either side.
inline constexpr double kOnTheLine = 6.0 / kSamples;

using Truth = std::function<bool(Vec2)>;
using Place = std::function<Vec2(Rng&)>;

struct Outcome {
  double excess = 0;        // mean over the queries
  double worst_excess = 0;  // of one query
  double share = 0;         // mean
  double integral = 0;      // mean
};

/// `h`: radius of the disc, of which the feelers know twice as much.
inline Outcome outcome(Room& room, const Place& place, const Truth& truth, float h = 1,
                       int feelers = 8) {
  Outcome out;
  Rng rng = rng_of(1);
  for (int i = 0; i < kQueries; ++i) {
    const Vec2 x = place(rng);
    FeelerQuery query = query_at(room, x, 2.2f * h, rng.uniform());
    query.feelers = feelers;
    const FreeRegion region(room.caster(), query);
    const Quality quality = judge(room, region, x, h, truth, kSamples);
    out.excess += quality.excess / kQueries;
    out.worst_excess = std::max(out.worst_excess, quality.excess);
    out.share += quality.share / kQueries;
    out.integral += quality.integral / kQueries;
  }
  EXPECT_NEAR(out.integral, 1, 0.005) << "area sampled over area computed";
  return out;
}

inline Place anywhere(
    Vec2 low, Vec2 high, Truth free = [](Vec2) { return true; }) {
  return [=](Rng& rng) {
    for (;;) {
      const Vec2 u = rng.uniform2();
      const Vec2 p{low.x + (high.x - low.x) * u.x, low.y + (high.y - low.y) * u.y};
      if (free(p)) return p;
    }
  };
}

inline void add_floor(Room& room, float z = 0) { room.floor(-kFar, -kFar, kFar, kFar, z); }

inline bool beyond_wall(Vec2 p) { return p.y > 0; }
inline bool in_corner(Vec2 p) { return p.x > 0 && p.y > 0; }
inline bool around_pillar(Vec2 p) { return p.x < 0 || p.y < 0; }
inline bool on_table(Vec2 p) { return std::abs(p.x) < 1 && std::abs(p.y) < 1; }

}  // namespace octolux::test
