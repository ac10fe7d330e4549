// See convex_hull.h.
#include "estimators/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace octolux {
namespace {

/// Twice the area of the triangle o, a, b; positive if it runs anticlockwise.
double turn(Point2 o, Point2 a, Point2 b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Adds a chain of the hull over the sorted points [first, last).
template <class Iterator>
void add_chain(std::vector<Point2>& hull, Iterator first, Iterator last) {
  const std::size_t start = hull.size();
  for (; first != last; ++first) {
    while (hull.size() >= start + 2 && !(turn(hull[hull.size() - 2], hull.back(), *first) > 0)) {
      hull.pop_back();
    }
    hull.push_back(*first);
  }
  hull.pop_back();  // the next chain starts there
}

/// Signed area of the triangle 0, a, b within the disc: the edge's part inside bounds a triangle,
/// its parts outside bound sectors.
double edge_area(Point2 a, Point2 b, double radius) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  if (!(length2 > 0)) return 0;
  const double along = -(a.x * dx + a.y * dy) / length2;  // nearest point to the origin
  const double cross = a.x * b.y - a.y * b.x;
  const double half2 = radius * radius / length2 - cross * cross / (length2 * length2);
  const double half = half2 > 0 ? std::sqrt(half2) : 0;
  const double first = std::clamp(along - half, 0.0, 1.0);
  const double last = std::clamp(along + half, 0.0, 1.0);
  const auto at = [&](double t) { return Point2{a.x + t * dx, a.y + t * dy}; };
  const auto angle = [](Point2 p, Point2 q) {
    return std::atan2(p.x * q.y - p.y * q.x, p.x * q.x + p.y * q.y);
  };
  double twice = cross * (last - first);
  if (first > 0) twice += radius * radius * angle(a, at(first));
  if (last < 1) twice += radius * radius * angle(at(last), b);
  return twice / 2;
}

}  // namespace

std::vector<Point2> convex_hull(std::vector<Point2>& points) {
  const auto less = [](Point2 a, Point2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); };
  const auto equal = [](Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end(), equal), points.end());
  if (points.size() < 3) return points;
  std::vector<Point2> hull;
  add_chain(hull, points.begin(), points.end());
  add_chain(hull, points.rbegin(), points.rend());
  return hull;
}

double polygon_area(const std::vector<Point2>& corners, double radius) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 a = corners[i], b = corners[(i + 1) % corners.size()];
    area += std::isinf(radius) ? (a.x * b.y - a.y * b.x) / 2 : edge_area(a, b, radius);
  }
  return area;
}

}  // namespace octolux
