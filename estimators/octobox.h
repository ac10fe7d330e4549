// OctoBoxes (Tobler & Maierhofer 2006, section 4): the eight-sided boxes around photons in the
// tangent plane, and their areas. Pure geometry, no photons' powers.
//
// Everything is seen from the query, which is the origin. A box is its support distances d_j along
// the eight directions at 45 j degrees: {p : p . u_j <= d_j}. Boxes of the corrected estimate
// contain the origin (d_j >= 0), because there is a surface at the query; the published ones do
// not. Arrays of eight are laid out for SIMD: one lane per side or octant. Pure functions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace octolux {

inline constexpr int kSides = 8;
using Lanes = std::array<float, kSides>;

/// Points of the tangent plane, one look-up's photons. The arrays are padded to whole groups of
/// eight with the origin, which is within every box that contains it.
class PlanePoints {
 public:
  void resize(int count);
  int size() const { return count_; }
  int padded_size() const { return (count_ + kSides - 1) / kSides * kSides; }
  Vec2 operator[](int i) const { return {x_[i], y_[i]}; }
  /// `inside`: within the disc that is estimated (all points shape the box).
  void set(int i, Vec2 p, bool inside) { x_[i] = p.x, y_[i] = p.y, inside_[i] = inside ? 1 : 0; }
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* inside() const { return inside_.data(); }  // 1 or 0
  /// Room for `count` points, to be written through the pointers, padding included.
  void start(int count);
  float* x() { return x_.data(); }
  float* y() { return y_.data(); }
  float* inside() { return inside_.data(); }
  /// Turns the axes by the angle whose cosine and sine are given. Returns octobox_with_origin().
  Lanes turn(Vec2 axis);

 private:
  int count_ = 0;  // the arrays may be longer
  std::vector<float> x_, y_, inside_;
};

/// Unit vector along the larger principal axis of the points; (1, 0) if there is none.
Vec2 principal_axis(const PlanePoints& points);

/// Support distances of the points and the origin.
Lanes octobox_with_origin(const PlanePoints& points);
/// Support distances of the points alone; size() >= 1.
Lanes octobox(const PlanePoints& points);

/// Area of the whole box: width times height less four corner triangles.
float octobox_area(const Lanes& box);
/// Area of the box within the disc of `radius` around the origin. d_j >= 0.
float octobox_area(const Lanes& box, float radius);
/// Less than that, but not by much: the disc's arcs are replaced by lines to the origin.
float octobox_area_at_least(const Lanes& box, float radius);

/// A convex polygon with the origin in each octant, all folded onto 0 <= b <= a with
/// a = max(|x|, |y|), b = min(|x|, |y|). Octant i spans the angles from 45 i to 45 (i + 1) degrees.
struct Octants {
  Lanes a{}, b{}, sum{}, difference{};  // greatest a, b, a + b and a - b
};

/// Number of points in each octant.
std::array<int, kSides> octant_counts(const PlanePoints& points);

/// Octant of a point, 0 to 7.
inline int octant(float x, float y) {
  const int left = x < 0, below = y<0, steep = std::abs(y)> std::abs(x);
  return 4 * below + 2 * (left ^ below) + (steep ^ left ^ below);
}
/// A point's supports in its octant.
struct Folded {
  float a, b, sum, difference;
};
inline Folded fold(float x, float y) {
  const float u = std::abs(x), v = std::abs(y);
  const float a = u > v ? u : v, b = u > v ? v : u;
  return {a, b, a + b, a - b};
}

/// The OctoBox of the points of each octant and the origin.
Octants octant_boxes(const PlanePoints& points);
/// The parts of one box in each octant. d_j >= 0.
Octants split(const Lanes& box);
/// Area in each octant within the disc of `radius`.
Lanes octant_areas(const Octants& octants, float radius);

}  // namespace octolux
