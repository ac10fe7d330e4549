// Double-precision vectors, for the few places where geometry is computed before it is rounded to
// float (shape.cpp, quadric.cpp). Deliberately small: everything else uses vec.h.
#pragma once

#include <cmath>

#include "core/vec.h"

namespace octolux {

struct Vec3d {
  double x = 0, y = 0, z = 0;

  constexpr Vec3d() = default;
  constexpr Vec3d(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  explicit constexpr Vec3d(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
};

constexpr Vec3d operator+(Vec3d a, Vec3d b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3d operator-(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3d operator*(Vec3d a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3d cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3d a) { return std::sqrt(dot(a, a)); }
/// Rounded to float.
constexpr Vec3 to_float(Vec3d a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
/// Unit vector along `a`, or `fallback` where `a` is zero or not finite.
inline Vec3 unit_or(Vec3d a, Vec3 fallback) {
  const double l = length(a);
  return l > 0 && std::isfinite(l) ? to_float(a * (1 / l)) : fallback;
}

}  // namespace octolux
