// Rays, and how to start one on a surface without hitting that surface again.
#pragma once

#include "core/constants.h"
#include "core/vec.h"

namespace octolux {

struct Ray {
  Vec3 origin;     // [m]
  Vec3 direction;  // unit, except for a connecting ray, which ends at t = 1
  float t_min = 0;
  float t_max = kInfinity;
};

/// Bound on the absolute error [m] of a position computed in float near coordinates of this size:
/// a few units in the last place, so it scales with the scene and with its distance from zero.
inline float position_error_bound(Vec3 p) { return 8 * 0x1p-23f * max_component(abs(p)); }

/// Start of a ray that leaves `position` (known to within `error`) on a surface with geometric
/// normal `ng` towards `direction`: moved off the surface, to the side the ray goes to.
inline Vec3 offset_origin(Vec3 position, Vec3 ng, float error, Vec3 direction) {
  return position + ng * (dot(ng, direction) < 0 ? -error : error);
}

}  // namespace octolux
