// Where a light that is placed by a map of the scene file looks: the map's turn without its scale.
#pragma once

#include "core/affine.h"
#include "core/frame.h"
#include "core/vec3d.h"

namespace octolux {

/// Orthonormal columns of A: z, then x, then y, each less its part along those before.
inline Frame frame_of(const Affine& a) {
  const auto column = [&a](int j) { return Vec3d(a.m[0][j], a.m[1][j], a.m[2][j]); };
  const Vec3d z(unit_or(column(2), {0, 0, 1}));
  const Vec3d x(unit_or(column(0) - z * dot(z, column(0)), Frame::from_normal(to_float(z)).s));
  const Vec3d y = cross(z, x);
  return {to_float(x), to_float(y * (dot(y, column(1)) < 0 ? -1 : 1)), to_float(z)};
}

}  // namespace octolux
