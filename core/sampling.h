// Warps of the unit square, each next to its density. Local frames have z along the axis.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/constants.h"
#include "core/vec.h"

namespace octolux {

/// Uniform on the unit disk, concentric (Shirley & Chiu 1997): keeps strata compact.
inline Vec2 sample_disk(Vec2 u) {
  const float a = 2 * u.x - 1;
  const float b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const float r = wide ? a : b;
  const float phi = wide ? (kPi / 4) * (b / a) : (kPi / 2) - (kPi / 4) * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// The point that sample_disk() takes there, or nearly.
inline Vec2 square_of_disk(Vec2 d) {
  const float r = std::sqrt(d.x * d.x + d.y * d.y);
  const bool wide = std::abs(d.x) > std::abs(d.y);
  const float a = std::copysign(r, wide ? d.x : d.y);
  const float slope = r > 0 ? (wide ? d.y / d.x : d.x / d.y) : 0;
  const float b = a * (4 * kInvPi) * std::atan(slope);
  const auto unit = [](float v) { return std::clamp((v + 1) / 2, 0.0f, kOneMinusEpsilon); };
  return wide ? Vec2{unit(a), unit(b)} : Vec2{unit(b), unit(a)};
}

/// Cosine-distributed on the hemisphere z > 0 (Malley).
inline Vec3 sample_cosine_hemisphere(Vec2 u) {
  const Vec2 d = sample_disk(u);
  return {d.x, d.y, std::sqrt(std::max(1e-14f, 1 - d.x * d.x - d.y * d.y))};
}
inline float cosine_hemisphere_pdf_w(Vec3 w) { return w.z > 0 ? w.z * kInvPi : 0; }

/// Uniform on the unit sphere; density 1 / (4 pi).
inline Vec3 sample_sphere(Vec2 u) {
  const float z = 1 - 2 * u.x;
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  const float phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr float kUniformSpherePdfW = kInvPi / 4;

/// Uniform in the solid angle around +z where the versine, 1 - cos, is at most `versine`; density
/// 1 / (2 pi versine).
inline Vec3 sample_cone(Vec2 u, float versine) {
  const float v = u.x * versine;  // not by way of the cosine: cones may be very narrow
  const float r = std::sqrt(v * (2 - v));
  const float phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), 1 - v};
}

/// Van der Corput's radical inverse in base 2, of the low 24 bits.
inline float radical_inverse(std::uint32_t i) {
  std::uint32_t bits = 0;
  for (int b = 0; b < 24; ++b) bits |= ((i >> b) & 1u) << (23 - b);
  return static_cast<float>(bits) * 0x1p-24f;
}

/// Point `i` of the `n` of a Hammersley set, shifted round the unit square by `shift` (Cranley &
/// Patterson 1976): each point alone is uniform, together they are spread evenly.
inline Vec2 shifted_hammersley(std::uint32_t i, std::uint32_t n, Vec2 shift) {
  const auto wrap = [](float u) { return std::min(kOneMinusEpsilon, u < 1 ? u : u - 1); };
  return {wrap(static_cast<float>(i) / static_cast<float>(n) + shift.x),
          wrap(radical_inverse(i) + shift.y)};
}

/// Barycentrics (u, v) of a uniform point of a triangle.
inline Vec2 sample_triangle(Vec2 u) {
  const float root = std::sqrt(u.x);
  return {1 - root, u.y * root};
}

/// x in [0, 1] with density proportional to a (1 - x) + b x, neither negative; if both are 0, even.
/// The root of the quadratic that does not cancel; also right for u = 1.
inline float sample_linear(float u, float a, float b) {
  if (u == 0) return 0;
  const float root = std::sqrt(a * a * (1 - u) + b * b * u);
  return root > 0 ? std::min(u * (a + b) / (a + root), 1.0f) : u;
}

/// Power heuristic (Veach 1997, 9.2.4) of `n_a` samples of density `pdf_a` against `n_b` of
/// `pdf_b`. Densities may be infinite (not both) or so small that their squares underflow.
inline float power_heuristic(float n_a, float pdf_a, float n_b, float pdf_b) {
  const float a = n_a * pdf_a;
  const float b = n_b * pdf_b;
  if (a == 0 || std::isinf(b)) return 0;
  const float ratio = b / a;
  return 1 / (1 + ratio * ratio);
}

}  // namespace octolux
