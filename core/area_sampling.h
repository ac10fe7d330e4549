// Points of a surface that emits, as next-event estimation meets them from elsewhere.
#pragma once

#include <cmath>
#include <optional>

#include "core/light.h"
#include "core/vec3d.h"

namespace octolux {

/// `pdf_a` [m^-2] at y as density [sr^-1] of directions at x; 0 where y's front does not face x.
inline float to_pdf_w(double pdf_a, Vec3 x, const SurfacePoint& y) {
  const Vec3d to_x = Vec3d(x) - Vec3d(y.position);
  const double distance2 = dot(to_x, to_x);
  const double distance_cos = dot(Vec3d(y.ng), to_x);
  if (!(distance_cos > 0)) return 0;
  return static_cast<float>(pdf_a * distance2 * std::sqrt(distance2) / distance_cos);
}

/// y, chosen with density `pdf_a` [m^-2], as a sample of light at x, of that radiance; empty if it
/// faces away or no float holds its density.
inline std::optional<LightSample> towards(const SurfacePoint& y, Vec3 x, double pdf_a,
                                          Rgb radiance) {
  LightSample s;
  s.pdf_w = to_pdf_w(pdf_a, x, y);
  if (!(s.pdf_w > 0) || std::isinf(s.pdf_w)) return std::nullopt;
  s.wi = unit_or(Vec3d(y.position) - Vec3d(x), {0, 0, 1});
  s.radiance = radiance;
  s.at = y;
  return s;
}

}  // namespace octolux
