// Areas of OctoBoxes by Green's theorem: the boundary of box and disc is chords and arcs, and seen
// from the origin a chord at distance d from t1 to t2 bounds d (t2 - t1) / 2, an arc of angle g
// bounds r^2 g / 2. Written as loops over eight lanes without branches.
#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "estimators/octobox.h"

namespace octolux {
namespace {

constexpr float kSqrt2 = 1.41421356237309505f;
constexpr float kSqrtHalf = 0.70710678118654752f;
constexpr float kEighthTurn = kPi / 4;

/// atan2(t, d) for d >= 0; absolute error below 1e-7 (Abramowitz & Stegun 4.4.49).
inline float angle_of(float t, float d) {
  const float size = std::abs(t);
  const float low = size < d ? size : d;
  const float high = size < d ? d : size;
  const float q = low / (high > 0 ? high : 1.0f);
  const float s = q * q;
  float p = 0.0028662257f;
  p = p * s - 0.0161657367f;
  p = p * s + 0.0429096138f;
  p = p * s - 0.0752896400f;
  p = p * s + 0.1065626393f;
  p = p * s - 0.1420889944f;
  p = p * s + 0.1999355085f;
  p = p * s - 0.3333314528f;
  const float a = q + q * s * p;
  return std::copysign(size < d ? a : kPi / 2 - a, t);
}

inline float greater(float a, float b) { return a > b ? a : b; }

/// The part of a side inside the disc: the side's line is at distance d, and runs from t = from to
/// t = to along it.
struct Chord {
  float first, last;              // t of the ends
  float first_angle, last_angle;  // of the ends, from the direction of the side
  bool enters, leaves;            // did the disc cut the ends off?
};

inline Chord chord(float d, float from, float to, float radius) {
  const float half2 = radius * radius - d * d;
  const float half = std::sqrt(half2 > 0 ? half2 : 0.0f);
  Chord c;
  c.enters = from < -half || from > half;
  c.leaves = to < -half || to > half;
  c.first = std::min(std::max(from, -half), half);
  c.last = std::min(std::max(to, -half), half);
  c.first_angle = angle_of(c.first, d);
  c.last_angle = angle_of(c.last, d);
  return c;
}

/// (kSides of them) the lanes rotated: result[j] = v[j + by].
inline Lanes rotated(const Lanes& v, int by) {
  Lanes r;
  for (int j = 0; j < kSides; ++j) r[j] = v[(j + by) & (kSides - 1)];
  return r;
}

}  // namespace

void PlanePoints::resize(int count) {
  count_ = count;
  const std::size_t padded = static_cast<std::size_t>((count + kSides - 1) / kSides) * kSides;
  x_.resize(padded);
  y_.resize(padded);
  inside_.resize(padded);
  std::fill(x_.begin() + count, x_.end(), 0.0f);
  std::fill(y_.begin() + count, y_.end(), 0.0f);
  std::fill(inside_.begin() + count, inside_.end(), 0.0f);
}

void PlanePoints::turn(Vec2 axis) {
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const float x = x_[i] * axis.x + y_[i] * axis.y;
    const float y = y_[i] * axis.x - x_[i] * axis.y;
    x_[i] = x;
    y_[i] = y;
  }
}

Vec2 principal_axis(const PlanePoints& points) {
  Lanes sx{}, sy{}, sxx{}, sxy{}, syy{};
  for (int i = 0; i < points.padded_size(); i += kSides) {
    for (int j = 0; j < kSides; ++j) {
      const float x = points.x()[i + j];
      const float y = points.y()[i + j];
      sx[j] += x;
      sy[j] += y;
      sxx[j] += x * x;
      sxy[j] += x * y;
      syy[j] += y * y;
    }
  }
  const auto total = [](const Lanes& v) {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
  };
  const float n = static_cast<float>(points.size());
  const float mx = total(sx), my = total(sy);
  const float difference = (total(sxx) - mx * mx / n) - (total(syy) - my * my / n);
  const float twice = 2 * (total(sxy) - mx * my / n);
  const float length = std::sqrt(difference * difference + twice * twice);
  if (!(length > 0)) return {1, 0};
  // Half the angle of (difference, twice), by the formula without cancellation.
  const float large = std::sqrt((1 + std::abs(difference) / length) / 2);
  const float small = twice / length / (2 * large);
  return difference >= 0 ? Vec2{large, small} : Vec2{std::abs(small), std::copysign(large, twice)};
}

Lanes octobox_with_origin(const PlanePoints& points) {
  std::array<Lanes, kSides> most{};
  for (int i = 0; i < points.padded_size(); i += kSides) {
    for (int j = 0; j < kSides; ++j) {
      const float x = points.x()[i + j];
      const float y = points.y()[i + j];
      const float sides[kSides] = {x, x + y, y, y - x, -x, -(x + y), -y, -(y - x)};
      for (int k = 0; k < kSides; ++k) most[k][j] = greater(most[k][j], sides[k]);
    }
  }
  Lanes box;
  for (int k = 0; k < kSides; ++k) {
    const float support = *std::max_element(most[k].begin(), most[k].end());
    box[k] = k % 2 == 0 ? support : support * kSqrtHalf;
  }
  return box;
}

Lanes octobox(const PlanePoints& points) {
  Lanes box;
  box.fill(-kInfinity);
  for (int i = 0; i < points.size(); ++i) {
    const float x = points.x()[i], y = points.y()[i];
    const float p = (x + y) * kSqrtHalf, m = (y - x) * kSqrtHalf;
    const float sides[kSides] = {x, p, y, m, -x, -p, -y, -m};
    for (int k = 0; k < kSides; ++k) box[k] = greater(box[k], sides[k]);
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

float octobox_area(const Lanes& box, float radius) {
  const Lanes next = rotated(box, 1), previous = rotated(box, -1);
  Lanes chords, first_angle, last_angle, enters, leaves;
  for (int j = 0; j < kSides; ++j) {
    const float d = box[j];
    const Chord c = chord(d, d - kSqrt2 * previous[j], kSqrt2 * next[j] - d, radius);
    chords[j] = d * (c.last - c.first);
    first_angle[j] = c.first_angle;
    last_angle[j] = c.last_angle;
    enters[j] = c.enters ? 1.0f : 0.0f;
    leaves[j] = c.leaves ? 1.0f : 0.0f;
  }
  const Lanes next_angle = rotated(first_angle, 1), next_enters = rotated(enters, 1);
  float twice = 0, arcs = 0;
  for (int j = 0; j < kSides; ++j) {
    twice += chords[j];
    const float arc = kEighthTurn + next_angle[j] - last_angle[j];
    arcs += leaves[j] + next_enters[j] > 0 ? arc : 0.0f;
  }
  return std::max((twice + arcs * (radius * radius)) / 2, 0.0f);
}

Octants octant_boxes(const PlanePoints& points) {
  std::array<std::array<float, 4>, kSides> most{};
  for (int i = 0; i < points.size(); ++i) {
    const float x = points.x()[i], y = points.y()[i];
    const Folded p = fold(x, y);
    const float supports[4] = {p.a, p.b, p.sum, p.difference};
    std::array<float, 4>& m = most[octant(x, y)];
    for (int k = 0; k < 4; ++k) m[k] = greater(m[k], supports[k]);
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
    parts.sum[i] = std::min(std::min(p, a + b), std::min(m + 2 * b, 2 * a));
  }
  return parts;
}

Lanes octant_areas(const Octants& octants, float radius) {
  Lanes areas;
  for (int i = 0; i < kSides; ++i) {
    const float a = octants.a[i], b = octants.b[i], p = octants.sum[i], m = octants.difference[i];
    // Sides at -45, 0, 45 and 90 degrees, from (m, 0) over (a, a - m), (a, p - a), (p - b, b) to
    // (b, b).
    const float da = a, db = b, dp = p * kSqrtHalf, dm = m * kSqrtHalf;
    const Chord cm = chord(dm, dm, (2 * a - m) * kSqrtHalf, radius);
    const Chord ca = chord(da, a - m, p - a, radius);
    const Chord cp = chord(dp, (p - 2 * a) * kSqrtHalf, (2 * b - p) * kSqrtHalf, radius);
    const Chord cb = chord(db, b - p, -b, radius);
    float arcs = cm.enters ? cm.first_angle - kEighthTurn : 0.0f;
    arcs += cm.leaves || ca.enters ? kEighthTurn + ca.first_angle - cm.last_angle : 0.0f;
    arcs += ca.leaves || cp.enters ? kEighthTurn + cp.first_angle - ca.last_angle : 0.0f;
    arcs += cp.leaves || cb.enters ? kEighthTurn + cb.first_angle - cp.last_angle : 0.0f;
    arcs += cb.leaves ? -kEighthTurn - cb.last_angle : 0.0f;
    const float twice = dm * (cm.last - cm.first) + da * (ca.last - ca.first) +
                        dp * (cp.last - cp.first) + db * (cb.last - cb.first);
    areas[i] = std::max((twice + arcs * (radius * radius)) / 2, 0.0f);
  }
  return areas;
}

}  // namespace octolux
