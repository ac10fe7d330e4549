// The two forms of the OctoBox estimate. Distances are in units of the look-up's radius.
#include "estimators/octobox_fit.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/error.h"
#include "estimators/simd8.h"

namespace octolux {
namespace {

constexpr float kSqrtHalf = 0.70710678118654752f;

Float8 smooth_step(float low, float high, Float8 x) {
  const Float8 t = min8(max8((x - low) / (high - low), splat8(0)), splat8(1));
  return t * t * (3 - 2 * t);
}

/// A box that leaves much of the disc empty has met an edge, and should lie along it. The principal
/// axes are only near that at few photons, and 22.5 degrees off in a corner of 45: so of six axes
/// the one with the smallest area is taken. On an open plane a box is hardly ever so small, so this
/// does not disturb the mean there.
Lanes align(PlanePoints& points) {
  constexpr int kAxes = 6;
  constexpr float kLargestShare = 0.75f;
  constexpr float kMissing = 12.5f;  // photons' worth of disc; the box misses 7 on average
  const Lanes principal = points.turn(principal_axis(points));
  const float share = std::min(kLargestShare, 1 - kMissing / static_cast<float>(points.size()));
  if (octobox_area_at_least(principal, 1) > share * kPi) return principal;
  float best_area = octobox_area(principal, 1);
  if (best_area > share * kPi) return principal;
  thread_local PlanePoints turned;
  turned = points;
  constexpr Vec2 kStep{0.99144486137381041f, 0.13052619222005159f};  // 7.5 degrees
  Vec2 axis{1, 0}, best_axis = axis;
  for (int i = 1; i < kAxes; ++i) {
    axis = {axis.x * kStep.x - axis.y * kStep.y, axis.x * kStep.y + axis.y * kStep.x};
    const float area = octobox_area(turned.turn(kStep), 1);
    if (area < best_area) best_area = area, best_axis = axis;
  }
  return best_axis.x == 1 ? principal : points.turn(best_axis);
}

/// Set where a point is strictly inside the box. Compares what octobox_with_origin computed, bit
/// for bit.
__attribute__((always_inline)) inline Mask8 is_within(const Lanes& box, Float8 x, Float8 y) {
  const Float8 p = (x + y) * kSqrtHalf, m = (y - x) * kSqrtHalf;
  return (x < box[0]) & (p < box[1]) & (y < box[2]) & (m < box[3]) & (-x < box[4]) & (-p < box[5]) &
         (-y < box[6]) & (-m < box[7]);
}

/// Eight points folded into their octants.
struct Folded8 {
  Float8 a, b, sum, difference;
};
__attribute__((always_inline)) inline Folded8 fold8(Float8 x, Float8 y) {
  const Float8 u = abs8(x), v = abs8(y);
  const Float8 a = max8(u, v), b = min8(u, v);
  return {a, b, a + b, a - b};
}

/// Octants (0 to 7) of eight points, as octant() has them.
__attribute__((always_inline)) inline Mask8 octants_of(Float8 x, Float8 y) {
  const Mask8 left = x < 0, below = y<0, steep = abs8(y)> abs8(x);
  return (below & 4) | ((left ^ below) & 2) | ((steep ^ left ^ below) & 1);
}

/// The same as octant_boxes(), eight points at once: each point is one vector of its four supports.
Octants octant_supports(const PlanePoints& points) {
  Float4 most[kSides] = {};
  for (int i = 0, end = points.padded_size(); i < end; i += kSides) {
    const Float8 x = load8(points.x() + i), y = load8(points.y() + i);
    const Folded8 p = fold8(x, y);
    Float4 supports[kSides];
    transpose8(p.a, p.b, p.sum, p.difference, supports);
    const Mask8 octants = octants_of(x, y);
    for (int k = 0; k < kSides; ++k) {
      Float4& m = most[octants[k]];
      m = supports[k] > m ? supports[k] : m;
    }
  }
  Octants boxes;
  for (int i = 0; i < kSides; ++i) {
    boxes.a[i] = most[i][0];
    boxes.b[i] = most[i][1];
    boxes.sum[i] = most[i][2];
    boxes.difference[i] = most[i][3];
  }
  return boxes;
}

/// Points inside: in each octant, `share` of a point for its own box, the rest for the common one.
float count_inside_octants(const PlanePoints& points, const Lanes& box, const Octants& own,
                           Float8 share) {
  const Float8 a = load8(own.a.data()), b = load8(own.b.data());
  const Float8 sum = load8(own.sum.data()), difference = load8(own.difference.data());
  Float8 count = {};
  for (int i = 0, end = points.padded_size(); i < end; i += kSides) {
    const Float8 x = load8(points.x() + i), y = load8(points.y() + i);
    const Folded8 p = fold8(x, y);
    const Mask8 k = octants_of(x, y);
    const Mask8 within_own = (p.a < lookup8(a, k)) & (p.b < lookup8(b, k)) &
                             (p.sum < lookup8(sum, k)) & (p.difference < lookup8(difference, k));
    const Float8 s = lookup8(share, k);
    count += load8(points.inside() + i) *
             ((1 - s) * ones8(is_within(box, x, y)) + s * ones8(within_own));
  }
  return sum8(count);
}

Fit fit_octants(const PlanePoints& points, const Lanes& box, const Lanes& own_share, float radius) {
  const Octants own = octant_supports(points);
  const Lanes own_areas = octant_areas(own, radius);
  const Lanes common_areas = octant_areas(split(box), radius);
  float area = 0;  // in the order of the octants
  for (int i = 0; i < kSides; ++i) {
    area += (1 - own_share[i]) * common_areas[i] + own_share[i] * own_areas[i];
  }
  return {count_inside_octants(points, box, own, load8(own_share.data())), area};
}

/// How far each octant goes by its own box: where it has photons enough (the paper: about 50), and
/// where it has so few that it cannot be open. The latter by Anscombe's root, a standard normal
/// deviate if the octant were open.
Lanes own_shares(const PlanePoints& points) {
  constexpr float kEnough = 20, kPlenty = 60;            // photons
  constexpr float kDoubtful = 2.3f, kImpossible = 3.6f;  // deviations
  constexpr int kNever = 20;  // so few photons are not enough, nor is their absence impossible
  Lanes shares{};
  if (points.size() <= kNever) return shares;
  const std::array<int, kSides> counts = octant_counts(points);
  Float8 count;
  for (int i = 0; i < kSides; ++i) count[i] = static_cast<float>(counts[i]);
  const float expected = std::sqrt(static_cast<float>(points.size()) / kSides + 0.375f);
  const Float8 missing = 2 * (expected - sqrt8(count + 0.375f));
  store8(shares.data(),
         max8(smooth_step(kEnough, kPlenty, count), smooth_step(kDoubtful, kImpossible, missing)));
  return shares;
}

}  // namespace

OctantUse parse_octant_use(const std::string& name) {
  if (name == "auto") return OctantUse::automatic;
  if (name == "one") return OctantUse::one;
  if (name == "eight") return OctantUse::eight;
  throw Error(unknown_name("octants", name, {"auto", "one", "eight"}));
}

float count_inside(const PlanePoints& points, const Lanes& box) {
  Float8 count = {};
  for (int i = 0, end = points.padded_size(); i < end; i += kSides) {
    const Float8 x = load8(points.x() + i), y = load8(points.y() + i);
    const Float8 inside = load8(points.inside() + i);
    count += is_within(box, x, y) ? inside : splat8(0);
  }
  return sum8(count);
}

Fit fit_octobox(PlanePoints& points, float radius, OctantUse use) {
  const Lanes box = align(points);
  Lanes shares{};
  if (use == OctantUse::eight) shares.fill(1);
  if (use == OctantUse::automatic) shares = own_shares(points);
  const bool one = std::all_of(shares.begin(), shares.end(), [](float s) { return s == 0; });
  if (one) return {count_inside(points, box), octobox_area(box, radius)};
  return fit_octants(points, box, shares, radius);
}

float published_octobox_area(const PlanePoints& points, OctantUse use) {
  constexpr float kEnough = 50;  // photons per octant
  if (points.size() == 0) return 0;
  const float one = octobox_area(octobox(points));
  if (use == OctantUse::one) return one;
  const Octants own = octant_boxes(points);
  float eight = 0;
  for (int i = 0; i < kSides; ++i) {
    const float a = own.a[i], b = own.b[i], p = own.sum[i], m = own.difference[i];
    // Width times height less the corners (a, 0), (a, b) and, where b = a ends the octant, (0, b).
    eight += a * b - ((a - m) * (a - m) + (a + b - p) * (a + b - p) + b * b) / 2;
  }
  if (use == OctantUse::eight) return eight;
  const std::array<int, kSides> counts = octant_counts(points);
  const int fewest = *std::min_element(counts.begin(), counts.end());
  const float share = std::min(static_cast<float>(fewest) / kEnough, 1.0f);
  return (1 - share) * one + share * eight;
}

}  // namespace octolux
