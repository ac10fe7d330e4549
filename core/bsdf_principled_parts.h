// What Disney's material for bodies and that for thin sheets have in common (Burley 2012 and 2015):
// roughness to microfacets, the diffuse lobe, colours without brightness.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/fresnel.h"
#include "core/texture.h"

namespace octolux {

inline float mix(float t, float a, float b) { return a + (b - a) * t; }

/// May it be other than 0?
inline bool present(const Scalar& s) { return !s.is_constant() || s.mean() > 0; }

/// alpha along the tangent and across (Burley 2012, 5.4).
inline Vec2 alphas(float roughness, float anisotropic) {
  const float aspect = std::sqrt(1 - 0.9f * anisotropic);
  const float r2 = roughness * roughness;
  return {std::max(0.001f, r2 / aspect), std::max(0.001f, r2 * aspect)};
}

/// `base` without its brightness.
inline Rgb tint_of(Rgb base) {
  const float y = luminance(base);
  return y > 0 ? base / y : Rgb(1);
}

/// f [sr^-1] of the diffuse lobe with retro-reflection, blended with the subsurface look by
/// `flatness` (Burley 2015, 4.2). Cosines of both directions, and with the half vector.
inline float disney_diffuse(float roughness, float flatness, float cos_o, float cos_i,
                            float cos_m) {
  const float so = schlick_weight(cos_o), si = schlick_weight(cos_i);
  const float retro = 2 * roughness * cos_m * cos_m;
  const float lambert =
      (1 - 0.5f * so) * (1 - 0.5f * si) + retro * (so + si + so * si * (retro - 1));
  const float fss = mix(so, 1, 0.5f * retro) * mix(si, 1, 0.5f * retro);
  const float flat = 1.25f * (fss * (1 / (cos_o + cos_i) - 0.5f) + 0.5f);
  return kInvPi * mix(flatness, lambert, flat);
}

}  // namespace octolux
