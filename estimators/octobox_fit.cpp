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

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
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
  points.turn(principal_axis(points));
  Lanes best = octobox_with_origin(points);
  float best_area = octobox_area(best, 1);
  const float share = std::min(kLargestShare, 1 - kMissing / static_cast<float>(points.size()));
  if (best_area > share * kPi) return best;
  thread_local PlanePoints turned;
  turned = points;
  constexpr Vec2 kStep{0.99144486137381041f, 0.13052619222005159f};  // 7.5 degrees
  Vec2 axis{1, 0}, best_axis = axis;
  for (int i = 1; i < kAxes; ++i) {
    turned.turn(kStep);
    axis = {axis.x * kStep.x - axis.y * kStep.y, axis.x * kStep.y + axis.y * kStep.x};
    const float area = octobox_area(octobox_with_origin(turned), 1);
    if (area < best_area) best_area = area, best_axis = axis;
  }
  if (best_axis.x == 1) return best;
  points.turn(best_axis);
  return octobox_with_origin(points);
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

/// The points in order of their octants, each octant padded to whole groups of eight.
struct SortedPoints {
  PlanePoints points;
  std::array<int, kSides + 1> start;
};

void sort_by_octant(const PlanePoints& points, SortedPoints& sorted) {
  const std::array<int, kSides> counts = octant_counts(points);
  sorted.start[0] = 0;
  for (int i = 0; i < kSides; ++i) {
    sorted.start[i + 1] = sorted.start[i] + (counts[i] + kSides - 1) / kSides * kSides;
  }
  sorted.points.resize(sorted.start[kSides]);
  std::array<int, kSides> next;
  for (int i = 0; i < kSides; ++i) {
    next[i] = sorted.start[i];
    for (int k = next[i] + counts[i]; k < sorted.start[i + 1]; ++k) {
      sorted.points.set(k, {0, 0}, false);
    }
  }
  for (int i = 0; i < points.size(); ++i) {
    const Vec2 p = points[i];
    sorted.points.set(next[octant(p.x, p.y)]++, p, points.inside()[i] > 0);
  }
}

Octants sorted_octant_boxes(const SortedPoints& sorted) {
  Octants boxes;
  for (int i = 0; i < kSides; ++i) {
    Float8 most[kSides] = {};
    for (int k = sorted.start[i]; k < sorted.start[i + 1]; k += kSides) {
      const Folded8 p = fold8(load8(sorted.points.x() + k), load8(sorted.points.y() + k));
      most[0] = max8(most[0], p.a);
      most[1] = max8(most[1], p.b);
      most[2] = max8(most[2], p.sum);
      most[3] = max8(most[3], p.difference);
    }
    const Float8 support = reduce8(most, Max8{});
    boxes.a[i] = support[0];
    boxes.b[i] = support[1];
    boxes.sum[i] = support[2];
    boxes.difference[i] = support[3];
  }
  return boxes;
}

/// Points of octant i inside its boxes: `share` of a point for its own, the rest for the common
/// one.
float count_octant(const SortedPoints& sorted, int i, const Lanes& box, const Octants& own,
                   float share) {
  Float8 count = {};
  for (int k = sorted.start[i]; k < sorted.start[i + 1]; k += kSides) {
    const Float8 x = load8(sorted.points.x() + k), y = load8(sorted.points.y() + k);
    const Folded8 p = fold8(x, y);
    const Mask8 within_own = (p.a < own.a[i]) & (p.b < own.b[i]) & (p.sum < own.sum[i]) &
                             (p.difference < own.difference[i]);
    count += load8(sorted.points.inside() + k) *
             ((1 - share) * ones8(is_within(box, x, y)) + share * ones8(within_own));
  }
  return sum8(count);
}

Fit fit_octants(const PlanePoints& points, const Lanes& box, const Lanes& own_share, float radius) {
  thread_local SortedPoints sorted;
  sort_by_octant(points, sorted);
  const Octants own = sorted_octant_boxes(sorted);
  const Lanes own_area = octant_areas(own, radius);
  const Lanes common_area = octant_areas(split(box), radius);
  Fit fit;
  for (int i = 0; i < kSides; ++i) {
    fit.area += (1 - own_share[i]) * common_area[i] + own_share[i] * own_area[i];
    fit.count += count_octant(sorted, i, box, own, own_share[i]);
  }
  return fit;
}

/// How far each octant goes by its own box: where it has photons enough (the paper: about 50), and
/// where it has so few that it cannot be open. The latter by Anscombe's root, a standard normal
/// deviate if the octant were open.
Lanes own_shares(const PlanePoints& points) {
  const std::array<int, kSides> counts = octant_counts(points);
  const float expected = std::sqrt(static_cast<float>(points.size()) / kSides + 0.375f);
  Lanes shares;
  for (int i = 0; i < kSides; ++i) {
    const float count = static_cast<float>(counts[i]);
    const float missing = 2 * (expected - std::sqrt(count + 0.375f));
    shares[i] = std::max(smooth_step(20, 60, count), smooth_step(2.3f, 3.6f, missing));
  }
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
  for (int i = 0; i < points.padded_size(); i += kSides) {
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
