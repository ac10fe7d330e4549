// What lights that are a single point have in common: where a map of the scene file turns them, how
// a place sees them, and their power from their picture.
#pragma once

#include <optional>

#include "core/affine.h"
#include "core/frame.h"
#include "core/light.h"
#include "core/sampling.h"
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

/// The light at `position`, of intensity(direction away from it) [W sr^-1], as x sees it; empty if
/// nothing arrives, also where the square of the distance under- or overflows.
template <class Intensity>
std::optional<LightSample> sample_point(Vec3 position, Vec3 x, const Intensity& intensity) {
  const Vec3 d = position - x;
  const float distance2 = length2(d);
  if (!(distance2 > 0)) return std::nullopt;
  LightSample s;
  s.wi = normalize(d);
  s.radiance = intensity(-s.wi) / distance2;
  if (!is_finite(s.radiance) || is_black(s.radiance)) return std::nullopt;
  s.pdf_w = 1;
  s.delta = true;
  s.at.position = position;
  s.at.ng = s.at.ns = -s.wi;
  return s;
}

/// `measure` times the mean of value(u) over the unit square, by side^2 points.
template <class Value>
Rgb integral(double measure, std::uint32_t side, const Value& value) {
  const std::uint32_t n = side * side;
  const float half = 0.5f / static_cast<float>(n);
  double sum[3] = {};
  for (std::uint32_t i = 0; i < n; ++i) {
    const Rgb c = value(shifted_hammersley(i, n, {half, half}));
    for (int k = 0; k < 3; ++k) sum[k] += static_cast<double>(c[k]);
  }
  const double scale = measure / n;
  return {static_cast<float>(sum[0] * scale), static_cast<float>(sum[1] * scale),
          static_cast<float>(sum[2] * scale)};
}

}  // namespace octolux
