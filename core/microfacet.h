// Rough surfaces as fields of tiny mirrors: the distributions of Beckmann and of GGX
// (Trowbridge-Reitz), anisotropic, with Smith's shadowing (Walter et al., EGSR 2007; Heitz, JCGT
// 3(2), 2014), and sampling of the normals visible from a direction (Heitz & d'Eon, EGSR 2014).
//
// Smith's G1 is the exact one for both distributions, so the density of visible normals
// D(m) G1(w, m) |w.m| / cos w integrates to one. G is the separable G1(wo) G1(wi), as in Mitsuba.
// Immutable, so thread-safe.
#pragma once

#include <algorithm>

#include "core/vec.h"

namespace octolux {

enum class MicrofacetKind { beckmann, ggx };

class Microfacet {
 public:
  /// Roughness below 1e-4 is raised to it, as in Mitsuba: float cannot resolve less.
  Microfacet(MicrofacetKind kind, float alpha_u, float alpha_v)
      : kind_(kind),
        alpha_u_(std::max(alpha_u, kMinimumAlpha)),
        alpha_v_(std::max(alpha_v, kMinimumAlpha)) {}

  MicrofacetKind kind() const { return kind_; }

  /// Density D(m) of the area of microfacets over the area of the surface [sr^-1].
  float d(Vec3 m) const;

  /// Smith's share of microfacets of normal m that are visible along v (either side).
  float g1(Vec3 v, Vec3 m) const;

  /// Density [sr^-1] of the normals seen from `wo`, which must be above the surface.
  float visible_pdf_w(Vec3 wo, Vec3 m) const;

  /// A normal of that density. GGX: Heitz, JCGT 7(4), 2018. Beckmann: inversion of the slopes' CDF
  /// (Jakob 2014).
  Vec3 sample_visible(Vec3 wo, Vec2 u) const;

  /// Mirror reflection by microfacets, without Fresnel; both directions must be above the surface.
  struct Reflection {
    float f = 0;      // D G / (4 cos wo cos wi) [sr^-1]
    float pdf_w = 0;  // of wi, when m is drawn by sample_visible [sr^-1]
    float cos_m = 0;  // between either direction and the microfacet normal
  };
  Reflection reflection(Vec3 wo, Vec3 wi) const;

  /// Density [sr^-1] of wi = reflect(wo, m) when m is drawn by sample_visible.
  float reflected_pdf_w(Vec3 wo, Vec3 m) const { return d(m) * g1(wo, m) / (4 * wo.z); }

  static constexpr float kMinimumAlpha = 1e-4f;

 private:
  MicrofacetKind kind_;
  float alpha_u_, alpha_v_;
};

}  // namespace octolux
