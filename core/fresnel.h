// Fresnel's equations, unpolarised: dielectrics (Born & Wolf 1999, 1.5.2) and conductors (complex
// index eta + i k; Moeller, "Optics", 1988), Schlick's approximation (1994), and the directions of
// mirror reflection and refraction. Cosines are signed: positive on the side of the normal, the
// "outside"; eta is always index inside / index outside. Pure functions.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/rgb.h"
#include "core/vec.h"

namespace octolux {

/// What a smooth dielectric boundary does with light along a direction.
struct DielectricFresnel {
  float reflectance = 1;    // [0, 1]; 1 beyond the critical angle
  float cos_refracted = 0;  // signed cosine of the refracted direction, on the other side
  float eta = 1;            // index on the refracted side over index on the incident side
};

inline DielectricFresnel fresnel_dielectric(float cos_incident, float eta_inside) {
  const float eta = cos_incident >= 0 ? eta_inside : 1 / eta_inside;
  const float ci = std::abs(cos_incident);
  const float ct2 = 1 - (1 - ci * ci) / (eta * eta);  // Snell
  if (ct2 <= 0) return {1, 0, eta};
  const float ct = std::sqrt(ct2);
  const float s = (ci - eta * ct) / (ci + eta * ct);
  const float p = (ct - eta * ci) / (ct + eta * ci);
  return {0.5f * (s * s + p * p), std::copysign(ct, -cos_incident), eta};
}

/// Reflectance of a conductor of index eta + i k; cosine >= 0.
float fresnel_conductor(float cos_incident, float eta, float k);
Rgb fresnel_conductor(float cos_incident, Rgb eta, Rgb k);

/// (1 - c)^5, the angular part of Schlick's approximation.
inline float schlick_weight(float cos_incident) {
  const float x = std::clamp(1 - cos_incident, 0.0f, 1.0f);
  return (x * x) * (x * x) * x;
}

/// Reflectance of a smooth dielectric boundary under uniform diffuse light, from outside for
/// eta > 1 (fit of d'Eon & Irving 2011) and from inside for eta < 1 (fit of Egan & Hilgeman 1973);
/// within 0.6 % for indices below 2. The fits Mitsuba's `plastic` uses, so that both agree.
float fresnel_diffuse_reflectance(float eta);

/// Mirror direction about z, and about the unit vector m.
constexpr Vec3 reflect(Vec3 w) { return {-w.x, -w.y, w.z}; }
constexpr Vec3 reflect(Vec3 w, Vec3 m) { return m * (2 * dot(w, m)) - w; }

/// Direction refracted at a boundary with normal z, or m; `fresnel` is of the cosine of w with it.
inline Vec3 refract(Vec3 w, const DielectricFresnel& fresnel) {
  const float ratio = 1 / fresnel.eta;
  return {-w.x * ratio, -w.y * ratio, fresnel.cos_refracted};
}
inline Vec3 refract(Vec3 w, Vec3 m, const DielectricFresnel& fresnel) {
  const float ratio = 1 / fresnel.eta;
  return m * (dot(w, m) * ratio + fresnel.cos_refracted) - w * ratio;
}

}  // namespace octolux
