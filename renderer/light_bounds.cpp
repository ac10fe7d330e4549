// light_bounds.h.
#include "renderer/light_bounds.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/vec3d.h"

namespace octolux {

using std::numbers::pi;

namespace {

/// Angle between unit vectors, exact to rounding also where it is small.
double angle_between(Vec3d a, Vec3d b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

/// Widens the cone of `a` until it holds that of `b`.
void add_normals(LightExtent& a, LightExtent b) {
  if (b.normals > a.normals) {
    std::swap(a.axis, b.axis);
    std::swap(a.normals, b.normals);
  }
  const Vec3d wide(a.axis), narrow(b.axis);
  const double between = angle_between(wide, narrow);
  if (between + static_cast<double>(b.normals) <= static_cast<double>(a.normals)) return;
  const double half =
      (static_cast<double>(a.normals) + between + static_cast<double>(b.normals)) / 2;
  const Vec3d across = narrow - wide * dot(narrow, wide);
  const double sine = length(across);
  if (half >= pi || !(sine > 0)) {
    a.normals = kPi;
    return;
  }
  const double turn = half - static_cast<double>(a.normals);
  a.axis = unit_or(wide * std::cos(turn) + across * (std::sin(turn) / sine), a.axis);
  a.normals = static_cast<float>(half);
}

}  // namespace

LightBounds LightBounds::united(const LightBounds& other) const {
  LightBounds both = *this;
  both.extent.bounds.add(other.extent.bounds);
  add_normals(both.extent, other.extent);
  both.extent.emission = std::max(extent.emission, other.extent.emission);
  both.weight += other.weight;
  return both;
}

double LightBounds::solid_angle() const {
  const double o = static_cast<double>(extent.normals);
  const double w = std::min(pi, o + static_cast<double>(extent.emission));
  const double beyond = 2 * (w - o) * std::sin(o) - std::cos(2 * w - o) + std::cos(o);
  return 2 * pi * (1 - std::cos(o)) + pi / 2 * beyond;
}

double LightBounds::cost() const {
  const auto radius = static_cast<double>(extent.bounds.radius());
  return weight * solid_angle() * radius * radius;
}

}  // namespace octolux
