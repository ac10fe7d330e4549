// Orthonormal frames. Local directions have z along the normal.
#pragma once

#include <cmath>

#include "core/vec.h"

namespace octolux {

struct Frame {
  Vec3 s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};

  /// Right-handed frame around the unit vector `n`; Duff et al., "Building an Orthonormal Basis,
  /// Revisited", JCGT 6(1), 2017.
  static Frame from_normal(Vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  /// The same with `s` along the part of `tangent` that is at right angles to `n`, as in Mitsuba;
  /// any frame where there is none (also for a zero tangent).
  static Frame from_tangent(Vec3 n, Vec3 tangent) {
    const Vec3 across = tangent - n * dot(n, tangent);
    const float l2 = length2(across);
    if (!(l2 > 0x1p-40f * length2(tangent))) return from_normal(n);
    const Vec3 s = across / std::sqrt(l2);
    return {s, cross(n, s), n};
  }

  Vec3 to_local(Vec3 v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
  Vec3 to_world(Vec3 v) const { return s * v.x + t * v.y + n * v.z; }
};

}  // namespace octolux
