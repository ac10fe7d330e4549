// Sphere, disk and cylinder under an affine map, exact. A ray is carried into object space, where
// the shape is the unit one; the map is linear in the direction, so t keeps its world meaning.
//
// Everything runs in double. The quadratic is solved as in Haines et al., "Precision Improvements
// for Ray/Sphere Intersection" (Ray Tracing Gems, 2019, ch. 7): the discriminant from the point of
// the line closest to the axis, and the smaller root from the product of the roots, so that neither
// far origins nor origins on the surface cancel. Stateless, so thread-safe.
#include "core/quadric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/ray.h"
#include "core/vec3d.h"

namespace octolux {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

Vec3d map_vector(const Affine& a, Vec3d v) {
  return {a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z,
          a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
          a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z};
}

Vec3d offset_of(const Affine& a) { return {a.m[0][3], a.m[1][3], a.m[2][3]}; }

Vec3d map_point(const Affine& a, Vec3d p) { return map_vector(a, p) + offset_of(a); }

/// A^T v.
Vec3d map_transposed(const Affine& a, Vec3d v) {
  return {a.m[0][0] * v.x + a.m[1][0] * v.y + a.m[2][0] * v.z,
          a.m[0][1] * v.x + a.m[1][1] * v.y + a.m[2][1] * v.z,
          a.m[0][2] * v.x + a.m[1][2] * v.y + a.m[2][2] * v.z};
}

/// The sizes of what is added up in A p + b: a result near zero is no more exact than they are.
Vec3 summand_magnitude(const Affine& a, Vec3d p) {
  std::array<float, 3> size{};
  for (int i = 0; i < 3; ++i) {
    size[i] = static_cast<float>(std::abs(a.m[i][0] * p.x) + std::abs(a.m[i][1] * p.y) +
                                 std::abs(a.m[i][2] * p.z) + std::abs(a.m[i][3]));
  }
  return {size[0], size[1], size[2]};
}

Vec3d column(const Affine& a, int j) { return {a.m[0][j], a.m[1][j], a.m[2][j]}; }

/// Roots, in order, of |o + t d| = 1. `o` and `d` have z = 0 for the cylinder. None: both infinite.
std::pair<double, double> unit_roots(Vec3d o, Vec3d d) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double a = dot(d, d);
  const double b = -dot(o, d);
  const double c = (length(o) - 1) * (length(o) + 1);
  const Vec3d closest = o + d * (b / a);
  const double discriminant = a * (1 - dot(closest, closest));
  if (!(discriminant >= 0 && a > 0)) return {inf, inf};
  const double q = b + std::copysign(std::sqrt(discriminant), b);
  if (q == 0) return {0, 0};
  return std::minmax(c / q, q / a);
}

/// The two places where the line meets the infinite surface.
std::pair<double, double> roots(Quadric::Kind kind, Vec3d o, Vec3d d) {
  if (kind == Quadric::Kind::disk) return {-o.z / d.z, -o.z / d.z};
  if (kind == Quadric::Kind::cylinder) return unit_roots({o.x, o.y, 0}, {d.x, d.y, 0});
  return unit_roots(o, d);
}

bool inside_limits(Quadric::Kind kind, Vec3d p) {
  if (kind == Quadric::Kind::disk) return p.x * p.x + p.y * p.y <= 1;
  if (kind == Quadric::Kind::cylinder) return p.z >= 0 && p.z <= 1;
  return true;
}

/// The nearest point of the unit shape, for a position that is on it up to rounding.
Vec3d reproject(Quadric::Kind kind, Vec3d p) {
  if (kind == Quadric::Kind::sphere) {
    const double r = length(p);
    return r > 0 ? p * (1 / r) : Vec3d{0, 0, 1};
  }
  const double r = std::hypot(p.x, p.y);
  if (kind == Quadric::Kind::disk) {
    const double s = r > 1 ? 1 / r : 1;
    return {p.x * s, p.y * s, 0};
  }
  const double z = std::clamp(p.z, 0.0, 1.0);
  return r > 0 ? Vec3d{p.x / r, p.y / r, z} : Vec3d{1, 0, z};
}

Vec2 texture_coordinates(Quadric::Kind kind, Vec3d p) {
  double phi = std::atan2(p.y, p.x);
  if (phi < 0) phi += kTwoPi;
  const auto around = static_cast<float>(phi / kTwoPi);
  switch (kind) {
    case Quadric::Kind::sphere:
      return {around, static_cast<float>(std::acos(std::clamp(p.z, -1.0, 1.0)) * 2 / kTwoPi)};
    case Quadric::Kind::disk:
      return {static_cast<float>(std::hypot(p.x, p.y)), around};
    default:
      return {around, static_cast<float>(p.z)};
  }
}

/// Midpoint rule, `steps` by 2 `steps`, of the area factor |cof(A) n| over the unit normals.
double quadrature(const Quadric& quadric, Vec3d cof_x, Vec3d cof_y, Vec3d cof_z, int steps) {
  const bool sphere = quadric.kind == Quadric::Kind::sphere;
  const int rows = sphere ? steps : 1;
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    const double z = sphere ? (2 * i + 1) / static_cast<double>(steps) - 1 : 0;
    const double r = std::sqrt((1 - z) * (1 + z));
    for (int j = 0; j < 2 * steps; ++j) {
      const double phi = (j + 0.5) * std::numbers::pi / steps;
      sum += length(cof_x * (r * std::cos(phi)) + cof_y * (r * std::sin(phi)) + cof_z * z);
    }
  }
  return sum / (rows * 2.0 * steps) * kTwoPi * (sphere ? 2 : 1);
}

}  // namespace

std::optional<QuadricHit> intersect(const Quadric& quadric, Vec3 origin, Vec3 direction,
                                    float t_min, float t_max) {
  const Vec3d o = map_point(quadric.to_object, Vec3d(origin));
  const Vec3d d = map_vector(quadric.to_object, Vec3d(direction));
  const auto [near, far] = roots(quadric.kind, o, d);
  for (const double t : {near, far}) {
    const auto rounded = static_cast<float>(t);
    if (!(rounded > t_min && rounded < t_max)) continue;
    const Vec3d p = o + d * t;
    if (inside_limits(quadric.kind, p)) {
      return QuadricHit{rounded, to_float(reproject(quadric.kind, p))};
    }
  }
  return std::nullopt;
}

SurfacePoint surface_point(const Quadric& quadric, Vec3 object_position) {
  const Vec3d p = reproject(quadric.kind, Vec3d(object_position));
  const bool disk = quadric.kind == Quadric::Kind::disk;
  const bool cylinder = quadric.kind == Quadric::Kind::cylinder;
  const Vec3d n = disk ? Vec3d{0, 0, 1} : Vec3d{p.x, p.y, cylinder ? 0 : p.z};
  SurfacePoint point;
  point.position = to_float(map_point(quadric.to_world, p));
  point.ng = unit_or(map_transposed(quadric.to_object, n), {0, 0, 1});
  if (quadric.flip) point.ng = -point.ng;
  point.ns = point.ng;
  point.uv = texture_coordinates(quadric.kind, p);
  point.error = position_error_bound(summand_magnitude(quadric.to_world, p));
  return point;
}

Tangents tangents(const Quadric& quadric, Vec3 object_position) {
  const Vec3d p = reproject(quadric.kind, Vec3d(object_position));
  const double r = std::hypot(p.x, p.y);
  const Vec3d outwards = r > 0 ? Vec3d{p.x / r, p.y / r, 0} : Vec3d{1, 0, 0};
  const Vec3d around = Vec3d{-p.y, p.x, 0} * kTwoPi;
  const auto world = [&](Vec3d v) { return to_float(map_vector(quadric.to_world, v)); };
  switch (quadric.kind) {
    case Quadric::Kind::sphere:
      return {world(around), world((outwards * p.z + Vec3d{0, 0, -r}) * std::numbers::pi)};
    case Quadric::Kind::disk:
      return {world(outwards), world(around)};
    default:
      return {world(around), world({0, 0, 1})};
  }
}

Bounds bounds(const Quadric& quadric) {
  const Affine& a = quadric.to_world;
  const bool sphere = quadric.kind == Quadric::Kind::sphere;
  const bool cylinder = quadric.kind == Quadric::Kind::cylinder;
  std::array<float, 3> lower{}, upper{};
  for (int i = 0; i < 3; ++i) {
    const double r = std::hypot(a.m[i][0], a.m[i][1], sphere ? a.m[i][2] : 0);
    const double along = cylinder ? a.m[i][2] : 0;
    const double lo = a.m[i][3] + std::min(0.0, along) - r;
    const double hi = a.m[i][3] + std::max(0.0, along) + r;
    lower[i] = std::nextafter(static_cast<float>(lo), -kInfinity);
    upper[i] = std::nextafter(static_cast<float>(hi), kInfinity);
  }
  return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
}

double area(const Quadric& quadric) {
  const Vec3d x = column(quadric.to_world, 0);
  const Vec3d y = column(quadric.to_world, 1);
  const Vec3d z = column(quadric.to_world, 2);
  const Vec3d cof_x = cross(y, z), cof_y = cross(z, x), cof_z = cross(x, y);
  if (quadric.kind == Quadric::Kind::disk) return std::numbers::pi * length(cof_z);
  double result = quadrature(quadric, cof_x, cof_y, cof_z, 32);
  for (int steps = 64; steps <= 2048; steps *= 2) {
    const double finer = quadrature(quadric, cof_x, cof_y, cof_z, steps);
    const bool settled = std::abs(finer - result) <= 1e-5 * finer;
    result = finer;
    if (settled) break;
  }
  return result;
}

}  // namespace octolux
