// OctoBoxes (Tobler & Maierhofer 2006, section 4): the eight-sided boxes around photons in the
// tangent plane, and their areas. Pure geometry, no photons' powers.
//
// Everything is seen from the query, which is the origin. A box is its support distances d_j along
// the eight directions at 45 j degrees: {p : p . u_j <= d_j}. Boxes of the corrected estimate
// contain the origin (d_j >= 0), because there is a surface at the query; the published ones do
// not. Arrays of eight are laid out for SIMD: one lane per side or octant. Pure functions.
#pragma once

#include <array>
#include <vector>

#include "core/vec.h"

namespace octolux {

inline constexpr int kSides = 8;
using Lanes = std::array<float, kSides>;

/// Points of the tangent plane, one look-up's photons. The arrays are padded to whole groups of
/// eight with the origin.
class PlanePoints {
 public:
  void resize(int count);
  int size() const { return count_; }
  int padded_size() const { return static_cast<int>(x_.size()); }
  Vec2 operator[](int i) const { return {x_[i], y_[i]}; }
  void set(int i, Vec2 p) { x_[i] = p.x, y_[i] = p.y; }
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  /// Turns all points by the angle whose cosine and sine are given, clockwise.
  void turn(Vec2 axis);

 private:
  int count_ = 0;
  std::vector<float> x_, y_;
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

/// A convex polygon with the origin in each octant, all folded onto 0 <= b <= a with
/// a = max(|x|, |y|), b = min(|x|, |y|). Octant i spans the angles from 45 i to 45 (i + 1) degrees.
struct Octants {
  Lanes a{}, b{}, sum{}, difference{};  // greatest a, b, a + b and a - b
};

/// Octant of a point.
inline int octant(Vec2 p) {
  const bool left = p.x < 0, below = p.y < 0, steep = std::abs(p.y) > std::abs(p.x);
  const int quadrant = below ? (left ? 2 : 3) : (left ? 1 : 0);
  return 2 * quadrant + static_cast<int>(steep != (left != below));
}

/// The OctoBox of the points of each octant and the origin.
Octants octant_boxes(const PlanePoints& points);
/// The parts of one box in each octant. d_j >= 0.
Octants split(const Lanes& box);
/// Area in each octant within the disc of `radius`.
Lanes octant_areas(const Octants& octants, float radius);

}  // namespace octolux
