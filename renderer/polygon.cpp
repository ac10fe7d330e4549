// Fan for strictly convex polygons, ear clipping for the rest; see polygon.h.
#include "renderer/polygon.h"

#include <cmath>
#include <cstddef>
#include <numeric>

namespace octolux {
namespace {

struct Point {
  double x = 0, y = 0;
};

/// Twice the signed area of a triangle, positive if it runs anticlockwise.
double cross(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Corners in the coordinate plane closest to the polygon's, seen so that it runs anticlockwise.
std::vector<Point> project(std::span<const Vec3> corners) {
  double nx = 0, ny = 0, nz = 0;
  const Vec3 o = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 p = corners[i], q = corners[(i + 1) % corners.size()];
    nx += (double(p.y) - q.y) * ((double(p.z) - o.z) + (double(q.z) - o.z));
    ny += (double(p.z) - q.z) * ((double(p.x) - o.x) + (double(q.x) - o.x));
    nz += (double(p.x) - q.x) * ((double(p.y) - o.y) + (double(q.y) - o.y));
  }
  const double ax = std::abs(nx), ay = std::abs(ny), az = std::abs(nz);
  const int drop = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
  int u = (drop + 1) % 3, v = (drop + 2) % 3;
  if ((drop == 0 ? nx : drop == 1 ? ny : nz) < 0) std::swap(u, v);
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const Vec3 p : corners) points.push_back({p[u], p[v]});
  return points;
}

bool strictly_convex(const std::vector<Point>& p) {
  double turned = 0;  // a pentagram turns left at every corner too, but twice around
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point a = p[i], b = p[(i + 1) % p.size()], c = p[(i + 2) % p.size()];
    const double area = cross(a, b, c);
    if (!(area > 0)) return false;
    turned += std::atan2(area, (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y));
  }
  return turned < 10;  // 2 pi, not 4 pi
}

/// The polygon while ears are cut from it: a ring of the corners that are left.
class Ring {
 public:
  explicit Ring(const std::vector<Point>& points)
      : p_(points), next_(points.size()), previous_(points.size()), left_(points.size()) {
    std::iota(next_.begin(), next_.end(), 1u);
    next_.back() = 0;
    for (std::uint32_t i = 0; i < next_.size(); ++i) previous_[next_[i]] = i;
  }

  std::vector<std::array<std::uint32_t, 3>> cut() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::uint32_t at = 0;
    while (left_ >= 3) {
      at = find_ear(at);
      triangles.push_back({previous_[at], at, next_[at]});
      next_[previous_[at]] = next_[at];
      previous_[next_[at]] = previous_[at];
      at = next_[next_[at]];  // not the neighbour, so that triangles do not all share one corner
      --left_;
    }
    return triangles;
  }

 private:
  double area(std::uint32_t i) const { return cross(p_[previous_[i]], p_[i], p_[next_[i]]); }

  /// The next corner that can be cut off. If there is none the polygon crosses itself or has no
  /// area: then a corner without area, or any.
  std::uint32_t find_ear(std::uint32_t start) const {
    std::uint32_t fallback = start, i = start;
    do {
      const double a = area(i);
      if (a > 0 && !covers_a_corner(i)) return i;
      if (a == 0) fallback = i;
      i = next_[i];
    } while (i != start);
    return fallback;
  }

  /// Does the triangle at `i` hold another corner that is not convex? Corners at the same place as
  /// one of its own (a bridge to a hole) do not count.
  bool covers_a_corner(std::uint32_t i) const {
    const Point a = p_[previous_[i]], b = p_[i], c = p_[next_[i]];
    for (std::uint32_t j = next_[next_[i]]; j != previous_[i]; j = next_[j]) {
      const Point q = p_[j];
      if (same(q, a) || same(q, b) || same(q, c) || area(j) > 0) continue;
      if (cross(a, b, q) >= 0 && cross(b, c, q) >= 0 && cross(c, a, q) >= 0) return true;
    }
    return false;
  }

  static bool same(Point a, Point b) { return a.x == b.x && a.y == b.y; }

  const std::vector<Point>& p_;
  std::vector<std::uint32_t> next_, previous_;
  std::size_t left_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3> corners) {
  const std::vector<Point> points = project(corners);
  if (!strictly_convex(points)) return Ring(points).cut();
  std::vector<std::array<std::uint32_t, 3>> fan;
  for (std::uint32_t i = 2; i < corners.size(); ++i) fan.push_back({0, i - 1, i});
  return fan;
}

}  // namespace octolux
