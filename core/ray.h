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

/// Bound on the error [m] of a surface's position as the next ray sees it, where the coordinates
/// that make it (a triangle's corners) are at most as large as p's. In units of 2^-24 p: the
/// position is rounded by 1/2 per axis, the origin moved off it by 1/2 again, that is sqrt(3) along
/// a slanted normal; the ray caster subtracts the corners (1/2 each), and its dot products for the
/// distance from the plane err by about 3 times the extent, which is up to 2 sqrt(3). In all 13;
/// measured with random planes and cosines down to 2^-14, some rays hit their own plane up to 12,
/// none at 16. It scales with the scene and with its distance from zero.
inline float position_error_bound(Vec3 p) { return 16 * 0x1p-24f * max_component(abs(p)); }

/// Start of a ray that leaves `position` (known to within `error`) on a surface with geometric
/// normal `ng` towards `direction`: moved off the surface, to the side the ray goes to.
inline Vec3 offset_origin(Vec3 position, Vec3 ng, float error, Vec3 direction) {
  return position + ng * (dot(ng, direction) < 0 ? -error : error);
}

/// One end of a connecting ray; as SurfacePoint has it.
struct RayEnd {
  Vec3 position;
  Vec3 ng;
  float error = 0;
};

/// From one surface to another, ending (at t = 1) just before it. The ray caster's error at the far
/// end grows with the distance, so the near end's bound counts there too.
inline Ray connecting_ray(const RayEnd& from, const RayEnd& to) {
  const Vec3 across = to.position - from.position;
  const Vec3 origin = offset_origin(from.position, from.ng, from.error, across);
  const Vec3 target = offset_origin(to.position, to.ng, from.error + to.error, -across);
  return {origin, target - origin, 0, 1};
}

}  // namespace octolux
