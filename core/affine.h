// Affine maps for loading: double precision, applied once, so that scene files with long chains of
// transforms lose nothing before positions become float.
#pragma once

#include <array>
#include <optional>

#include "core/vec.h"

namespace octolux {

/// p -> A p + b, with A in m[0..2][0..2] (row-major) and b in m[.][3].
struct Affine {
  std::array<std::array<double, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Vec3 point(Vec3 p) const;
  Vec3 vector(Vec3 v) const;
  /// The map of normals, A^-T n, not normalised. `inverse` is this map's inverse.
  static Vec3 normal(const Affine& inverse, Vec3 n);
  /// det A. Negative: mirrored. Zero: singular.
  double determinant() const;
  /// Empty if A is singular (or not finite).
  std::optional<Affine> inverse() const;
};

/// `outer` after `inner`.
Affine operator*(const Affine& outer, const Affine& inner);

Affine translation(double x, double y, double z);
Affine scaling(double x, double y, double z);
/// Rotation by `degrees` about the axis (x, y, z), which need not be unit length but not zero.
Affine rotation(double x, double y, double z, double degrees);
/// Camera-to-world: at `origin`, z towards `target`, y near `up` (Mitsuba's lookAt: x points left).
/// Empty if origin = target or `up` is parallel to the view.
std::optional<Affine> look_at(Vec3 origin, Vec3 target, Vec3 up);

}  // namespace octolux
