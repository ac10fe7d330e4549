// The integral of 1 - a d^2/h^2 over a convex part of a 45-degree sector within a disc, exactly.
//
// The sector is clipped by its half planes (Sutherland & Hodgman 1974); around the boundary, each
// edge p q contributes what lies between it and the origin: inside the disc the triangle 0 p q,
// with integral of 1: A = cross(p, q)/2, and of d^2: A (p.p + p.q + q.q)/6; outside the disc the
// circular sector of the same angle. In double: differences of large triangles must be exact
// enough for slivers. Pure.
#include "estimators/sector_integral.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"

namespace octolux {

namespace {

struct Point {
  double x = 0, y = 0;
};
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Point mix(Point a, Point b, double t) { return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

constexpr std::size_t kMostCorners = 3 + PhotonRegion::kLines + kMaxExtraLines;

/// A convex polygon of few corners.
struct Polygon {
  std::array<Point, kMostCorners> corners;
  int count = 0;

  void add(Point p) { corners[static_cast<std::size_t>(count++)] = p; }
};

/// Cuts off what is beyond the line a p = c.
void clip(Polygon& polygon, Point a, double c) {
  std::array<double, kMostCorners> outside;
  bool cuts = false;
  for (int i = 0; i < polygon.count; ++i) {
    outside[i] = dot(a, polygon.corners[i]) - c;
    cuts |= outside[i] > 0;
  }
  if (!cuts) return;
  Polygon rest;
  for (int i = 0; i < polygon.count; ++i) {
    const int next = i + 1 < polygon.count ? i + 1 : 0;
    const double dp = outside[i], dq = outside[next];
    if (dp <= 0) rest.add(polygon.corners[i]);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
      rest.add(mix(polygon.corners[i], polygon.corners[next], dp / (dp - dq)));
    }
  }
  polygon.count = rest.count;
  std::copy_n(rest.corners.begin(), rest.count, polygon.corners.begin());
}

/// Between the origin and the segment p q, which is inside the unit disc.
double triangle(Point p, Point q, double taper) {
  return 0.5 * cross(p, q) * (1 - taper / 6 * (dot(p, p) + dot(p, q) + dot(q, q)));
}

/// The sector of the unit disc from p to q.
double arc(Point p, Point q, double taper) {
  return std::atan2(cross(p, q), dot(p, q)) * (0.5 - 0.25 * taper);
}

/// The part of the unit disc between the origin and the segment p q.
double between(Point p, Point q, double taper) {
  const Point d = q - p;
  const double a = dot(d, d), b = dot(p, d), c = dot(p, p) - 1;
  if (!(a > 0)) return 0;
  const double root = b * b - a * c;
  if (!(root > 0)) return arc(p, q, taper);
  const double half = std::sqrt(root);
  const double enter = std::clamp((-b - half) / a, 0.0, 1.0);
  const double leave = std::clamp((-b + half) / a, 0.0, 1.0);
  if (!(enter < leave)) return arc(p, q, taper);
  const Point in = mix(p, q, enter), out = mix(p, q, leave);
  const double before = enter > 0 ? arc(p, in, taper) : 0;
  const double after = leave < 1 ? arc(out, q, taper) : 0;
  return before + triangle(in, out, taper) + after;
}

/// The sector in units of `unit`, cut off outside the unit disc by the tangent in its middle.
Polygon polygon_of(const PhotonRegion::Sector& sector, int index, float unit,
                   std::span<const HalfPlane> also) {
  static const std::array<Point, PhotonRegion::kSectors> kCorners = [] {
    std::array<Point, PhotonRegion::kSectors> corners;
    const double far = 1 / std::cos(std::numbers::pi / 8);
    for (int i = 0; i < PhotonRegion::kSectors; ++i) {
      const double angle = i * std::numbers::pi / 4;
      corners[i] = {far * std::cos(angle), far * std::sin(angle)};
    }
    return corners;
  }();
  Polygon polygon;
  polygon.add({0, 0});
  polygon.add(kCorners[index]);
  polygon.add(kCorners[(index + 1) % PhotonRegion::kSectors]);
  for (int i = 0; i < PhotonRegion::kLines; ++i) {
    const HalfPlane line = sector.line(i);
    if (line.c < unit) clip(polygon, {line.a.x, line.a.y}, line.c / unit);
  }
  for (const HalfPlane& line : also) {
    if (line.c < unit) clip(polygon, {line.a.x, line.a.y}, line.c / unit);
  }
  return polygon;
}

}  // namespace

double sector_integral(const PhotonRegion::Sector& sector, int index, float h, float taper,
                       std::span<const HalfPlane> also) {
  OCTOLUX_CHECK(also.size() <= kMaxExtraLines);
  const Polygon polygon = polygon_of(sector, index, h, also);
  double sum = 0;  // the first corner is the origin, and bounds nothing with its neighbours
  for (int i = 1; i + 1 < polygon.count; ++i) {
    sum += between(polygon.corners[i], polygon.corners[i + 1], taper);
  }
  return sum * h * h;
}

float sector_extent(const PhotonRegion::Sector& sector, int index, float limit) {
  const Polygon polygon = polygon_of(sector, index, limit, {});
  double farthest2 = 0;
  for (int i = 0; i < polygon.count; ++i) {
    farthest2 = std::max(farthest2, dot(polygon.corners[i], polygon.corners[i]));
  }
  return limit * static_cast<float>(std::sqrt(std::min(farthest2, 1.0)));
}

}  // namespace octolux
