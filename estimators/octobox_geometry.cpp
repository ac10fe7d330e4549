// Areas of OctoBoxes by Green's theorem: the boundary of box and disc is chords and arcs, and seen
// from the origin a chord at distance d from t1 to t2 bounds d (t2 - t1) / 2, an arc of angle g
// bounds r^2 g / 2. Written as loops over eight lanes without branches.
#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "estimators/octobox.h"
#include "estimators/simd8.h"

namespace octolux {
namespace {

constexpr float kSqrt2 = 1.41421356237309505f;
constexpr float kSqrtHalf = 0.70710678118654752f;
constexpr float kEighthTurn = kPi / 4;

/// atan2(t, d) for t, d >= 0; absolute error below 1e-7 (Abramowitz & Stegun 4.4.49).
inline Float8 angle_of(Float8 t, Float8 d) {
  const Float8 low = min8(t, d);
  const Float8 high = max8(t, d);
  const Float8 q = low / (high > 0 ? high : splat8(1));
  const Float8 s = q * q;
  Float8 p = splat8(0.0028662257f);
  p = p * s - 0.0161657367f;
  p = p * s + 0.0429096138f;
  p = p * s - 0.0752896400f;
  p = p * s + 0.1065626393f;
  p = p * s - 0.1420889944f;
  p = p * s + 0.1999355085f;
  p = p * s - 0.3333314528f;
  const Float8 a = q + q * s * p;
  return t < d ? a : kPi / 2 - a;
}

/// The parts of eight sides inside the disc: a side's line is at distance d, and runs from
/// t = from to t = to along it.
struct Chords {
  Float8 twice_area;               // of the triangles from the origin to the parts
  Float8 enters, leaves;           // 1: the disc cut the end off
  Float8 first_angle, last_angle;  // of ends cut off, from the direction of the side
};

inline Chords chords(Float8 d, Float8 from, Float8 to, float radius) {
  const Float8 half = sqrt8(max8(radius * radius - d * d, splat8(0)));
  const Float8 first = min8(max8(from, -half), half);
  const Float8 last = min8(max8(to, -half), half);
  Chords c;
  c.twice_area = d * (last - first);
  c.enters = ones8(first != from);
  c.leaves = ones8(last != to);
  // Ends that are cut off lie where the line meets the circle.
  const Float8 angle = angle_of(half, d);
  c.first_angle = first < 0 ? -angle : angle;
  c.last_angle = last < 0 ? -angle : angle;
  return c;
}

/// The largest supports so far. Zeros to begin with: the origin's.
struct Supports {
  Float8 right{}, upper_right{}, up{}, upper_left{}, left{}, lower_left{}, down{}, lower_right{};

  __attribute__((always_inline)) void add(Float8 x, Float8 y) {
    const Float8 sum = x + y, difference = y - x;
    right = max8(right, x);
    upper_right = max8(upper_right, sum);
    up = max8(up, y);
    upper_left = max8(upper_left, difference);
    left = min8(left, x);
    lower_left = min8(lower_left, sum);
    down = min8(down, y);
    lower_right = min8(lower_right, difference);
  }
  __attribute__((always_inline)) Lanes box() const {
    const Float8 most[kSides] = {right, upper_right, up,    upper_left,
                                 -left, -lower_left, -down, -lower_right};
    const Float8 scale{1, kSqrtHalf, 1, kSqrtHalf, 1, kSqrtHalf, 1, kSqrtHalf};
    Lanes box;
    store8(box.data(), reduce8(most, Max8{}) * scale);
    return box;
  }
};

}  // namespace

void PlanePoints::start(int count) {
  count_ = count;
  const std::size_t padded = static_cast<std::size_t>(padded_size());
  if (x_.size() >= padded) return;
  for (std::vector<float>* v : {&x_, &y_, &inside_}) v->resize(2 * padded);
}

void PlanePoints::resize(int count) {
  start(count);
  for (int i = count; i < padded_size(); ++i) x_[i] = y_[i] = inside_[i] = 0;
}

Lanes PlanePoints::turn(Vec2 axis) {
  float* xs = x_.data();
  float* ys = y_.data();
  Supports supports;
  for (int i = 0, end = padded_size(); i < end; i += kSides) {
    const Float8 x = load8(xs + i), y = load8(ys + i);
    const Float8 turned_x = x * axis.x + y * axis.y, turned_y = y * axis.x - x * axis.y;
    store8(xs + i, turned_x);
    store8(ys + i, turned_y);
    supports.add(turned_x, turned_y);
  }
  return supports.box();
}

Vec2 principal_axis(const PlanePoints& points) {
  Float8 sum_x{}, sum_y{}, sum_xx{}, sum_xy{}, sum_yy{};
  for (int i = 0, end = points.padded_size(); i < end; i += kSides) {
    const Float8 x = load8(points.x() + i), y = load8(points.y() + i);
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
    sum_yy += y * y;
  }
  const Float8 moments[8] = {sum_x, sum_y, sum_xx, sum_xy, sum_yy, {}, {}, {}};
  const Float8 m = reduce8(moments, Add8{});
  const float n = static_cast<float>(points.size());
  const float difference = (m[2] - m[0] * m[0] / n) - (m[4] - m[1] * m[1] / n);
  const float twice = 2 * (m[3] - m[0] * m[1] / n);
  const float length = std::sqrt(difference * difference + twice * twice);
  if (!(length > 0)) return {1, 0};
  // Half the angle of (difference, twice), by the formula without cancellation.
  const float large = std::sqrt((1 + std::abs(difference) / length) / 2);
  const float small = twice / length / (2 * large);
  return difference >= 0 ? Vec2{large, small} : Vec2{std::abs(small), std::copysign(large, twice)};
}

Lanes octobox_with_origin(const PlanePoints& points) {
  Supports supports;
  for (int i = 0, end = points.padded_size(); i < end; i += kSides) {
    supports.add(load8(points.x() + i), load8(points.y() + i));
  }
  return supports.box();
}

Lanes octobox(const PlanePoints& points) {
  Lanes box;
  box.fill(-kInfinity);
  for (int i = 0; i < points.size(); ++i) {
    const float x = points.x()[i], y = points.y()[i];
    const float p = (x + y) * kSqrtHalf, m = (y - x) * kSqrtHalf;
    const float sides[kSides] = {x, p, y, m, -x, -p, -y, -m};
    for (int k = 0; k < kSides; ++k) box[k] = std::max(box[k], sides[k]);
  }
  return box;
}

float octobox_area(const Lanes& box) {
  const float width = box[0] + box[4], height = box[2] + box[6];
  float corners = 0;
  for (int k = 1; k < kSides; k += 2) {
    const float leg = box[k - 1] + box[(k + 1) % kSides] - kSqrt2 * box[k];
    corners += leg * leg / 2;
  }
  return std::max(width * height - corners, 0.0f);
}

float octobox_area_at_least(const Lanes& box, float radius) {
  const Float8 d = load8(box.data());
  const Float8 next = __builtin_shufflevector(d, d, 1, 2, 3, 4, 5, 6, 7, 0);
  const Float8 previous = __builtin_shufflevector(d, d, 7, 0, 1, 2, 3, 4, 5, 6);
  const Float8 half = sqrt8(max8(radius * radius - d * d, splat8(0)));
  const Float8 first = min8(max8(d - kSqrt2 * previous, -half), half);
  const Float8 last = min8(max8(kSqrt2 * next - d, -half), half);
  return sum8(d * (last - first)) / 2;
}

float octobox_area(const Lanes& box, float radius) {
  const Float8 d = load8(box.data());
  const Float8 next = __builtin_shufflevector(d, d, 1, 2, 3, 4, 5, 6, 7, 0);
  const Float8 previous = __builtin_shufflevector(d, d, 7, 0, 1, 2, 3, 4, 5, 6);
  const Chords c = chords(d, d - kSqrt2 * previous, kSqrt2 * next - d, radius);
  const Float8 first = c.first_angle, enters = c.enters;
  const Float8 arcs =
      kEighthTurn - c.last_angle + __builtin_shufflevector(first, first, 1, 2, 3, 4, 5, 6, 7, 0);
  const Float8 cut = c.leaves + __builtin_shufflevector(enters, enters, 1, 2, 3, 4, 5, 6, 7, 0);
  const Float8 twice = c.twice_area + (cut > 0 ? arcs : splat8(0)) * (radius * radius);
  return std::max(sum8(twice) / 2, 0.0f);
}

std::array<int, kSides> octant_counts(const PlanePoints& points) {
  // Numbers of points that are left, below, steep, and all combinations; from them the octants.
  // A mask that is set is the integer -1.
  Mask8 lefts{}, belows{}, steeps{}, left_belows{}, left_steeps{}, below_steeps{}, alls{};
  for (int i = 0, end = points.padded_size(); i < end; i += kSides) {
    const Float8 x = load8(points.x() + i), y = load8(points.y() + i);
    const Mask8 left = x < 0, below = y<0, steep = abs8(y)> abs8(x);
    lefts -= left;
    belows -= below;
    steeps -= steep;
    left_belows -= left & below;
    left_steeps -= left & steep;
    below_steeps -= below & steep;
    alls -= left & below & steep;
  }
  const Mask8 sums[8] = {lefts, belows, steeps, left_belows, left_steeps, below_steeps, alls, {}};
  const Mask8 s = reduce8(sums, Add8{});
  const int left = s[0], below = s[1], steep = s[2], left_below = s[3];
  const int left_steep = s[4], below_steep = s[5], all = s[6];
  const int right_above = points.size() - left - below + left_below;
  const int right_above_steep = steep - left_steep - below_steep + all;
  return {right_above - right_above_steep,
          right_above_steep,
          left_steep - all,
          left - left_below - left_steep + all,
          left_below - all,
          all,
          below_steep - all,
          below - left_below - below_steep + all};
}

Octants octant_boxes(const PlanePoints& points) {
  std::array<std::array<float, 4>, kSides> most{};
  for (int i = 0; i < points.size(); ++i) {
    const float x = points.x()[i], y = points.y()[i];
    const Folded p = fold(x, y);
    const float supports[4] = {p.a, p.b, p.sum, p.difference};
    std::array<float, 4>& m = most[octant(x, y)];
    for (int k = 0; k < 4; ++k) m[k] = std::max(m[k], supports[k]);
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

Octants split(const Lanes& box) {
  Octants parts;
  for (int i = 0; i < kSides; ++i) {
    const bool mirrored = i % 2 == 1;  // b grows clockwise there
    const int j = (i + 1) % kSides, before = (i + 7) % kSides, after = (i + 2) % kSides;
    const float x = mirrored ? box[j] : box[i];
    const float y = mirrored ? box[before] : box[after];
    const float p = kSqrt2 * (mirrored ? box[i] : box[j]);
    const float m = kSqrt2 * (mirrored ? box[after] : box[before]);
    // Support distances of {0 <= b <= a} and the four half-planes together.
    const float b = std::min(std::min(x, y), p / 2);
    const float a = std::min(std::min(x, p), std::min(m + b, (p + m) / 2));
    const float difference = std::min(std::min(m, a), p);
    parts.b[i] = b;
    parts.a[i] = a;
    parts.difference[i] = difference;
    parts.sum[i] = std::min(p, a + b);
  }
  return parts;
}

Lanes octant_areas(const Octants& octants, float radius) {
  const Float8 a = load8(octants.a.data()), b = load8(octants.b.data());
  const Float8 p = load8(octants.sum.data()), m = load8(octants.difference.data());
  // Sides at -45, 0, 45 and 90 degrees, from (m, 0) over (a, a - m), (a, p - a), (p - b, b) to
  // (b, b).
  const Chords low = chords(m * kSqrtHalf, m * kSqrtHalf, (2 * a - m) * kSqrtHalf, radius);
  const Chords right = chords(a, a - m, p - a, radius);
  const Chords high =
      chords(p * kSqrtHalf, (p - 2 * a) * kSqrtHalf, (2 * b - p) * kSqrtHalf, radius);
  const Chords top = chords(b, b - p, -b, radius);
  const auto arc = [](const Chords& from, const Chords& to) {
    const Float8 angle = kEighthTurn + to.first_angle - from.last_angle;
    return from.leaves + to.enters > 0 ? angle : splat8(0);
  };
  const Float8 arcs = low.enters * (low.first_angle - kEighthTurn) + arc(low, right) +
                      arc(right, high) + arc(high, top) -
                      top.leaves * (kEighthTurn + top.last_angle);
  const Float8 twice = low.twice_area + right.twice_area + high.twice_area + top.twice_area +
                       arcs * (radius * radius);
  Lanes areas;
  store8(areas.data(), max8(twice / 2, splat8(0)));
  return areas;
}

}  // namespace octolux
