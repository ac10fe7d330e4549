// How a surface scatters light: the BSDF interface. The kinds we model are made by bsdf_makers.h.
//
// Directions are local: z along the shading normal, `wo` towards the viewer (or where the photon
// came from), `wi` towards where light comes from (or where the photon goes); both leave the
// surface. f is WITHOUT the cosine. A BSDF is a sum of lobes of three kinds, and every call says
// which kinds it asks about, because the light paths of photon mapping are told apart by them
// (DESIGN: S = delta or near-specular, D = everything else).
#pragma once

#include <optional>

#include "core/rgb.h"
#include "core/shape.h"
#include "core/texture.h"
#include "core/vec.h"

namespace octolux {

/// Set of lobe kinds.
enum class Lobes : unsigned {
  none = 0,
  smooth = 1,         // "D": diffuse and rough lobes
  near_specular = 2,  // "S" with a finite pdf: roughness below kNearSpecularAlpha
  delta = 4,          // "S": mirror reflection and refraction
  specular = 6,       // both kinds of S
  non_delta = 3,      // what next-event estimation can see
  all = 7,
};
constexpr Lobes operator|(Lobes a, Lobes b) { return Lobes(unsigned(a) | unsigned(b)); }
constexpr Lobes operator&(Lobes a, Lobes b) { return Lobes(unsigned(a) & unsigned(b)); }
constexpr bool any(Lobes a) { return a != Lobes::none; }

/// Microfacet roughness (Beckmann or GGX alpha) below which a lobe counts as specular, S: its light
/// is followed, not gathered from photons.
inline constexpr float kNearSpecularAlpha = 0.2f;

/// What a path carries. Radiance is scaled by the squared index ratio when it is refracted, flux
/// (photons) is not (Veach 1997, 5.2).
enum class Carried { radiance, flux };

struct BsdfSample {
  Vec3 wi;
  Rgb weight;       // f |cos wi| / pdf, of the lobes asked for
  float pdf_w = 0;  // [sr^-1] of the non-delta lobes asked for; for a delta lobe its probability
  Lobes lobe = Lobes::none;  // the kind that was sampled (exactly one)
  float eta = 1;             // index on wi's side over index on wo's side; 1 for reflection
};

/// Immutable after construction, so thread-safe. No allocation, no exception.
class Bsdf {
 public:
  virtual ~Bsdf() = default;

  /// f(wo, wi) [sr^-1] without cosine: sum over the non-delta lobes of the kinds in `lobes`.
  virtual Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes lobes, Carried carried) const = 0;

  /// Density [sr^-1] with which `sample` (same `lobes`) chooses wi through a non-delta lobe,
  /// including the probability of choosing that lobe.
  virtual float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes lobes) const = 0;

  /// A direction drawn from the lobes of the kinds in `lobes`; empty if there is none or it is
  /// black. `u_lobe` chooses the lobe, `u` the direction; both uniform in [0, 1).
  /// For a non-delta sample: weight = f(wo, wi, lobes) |cos wi| / pdf_w(wo, wi, lobes), so where a
  /// near-specular and a smooth lobe overlap it carries both.
  virtual std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                           Lobes lobes, Carried carried) const = 0;

  /// Hemispherical reflectance (roughly), for the `albedo` layer.
  virtual Rgb albedo(const SurfacePoint& at) const = 0;

  /// Share of light that goes straight on as if nothing were there (mask, thin pane), per channel.
  /// f, pdf_w and sample describe the rest: what they return is NOT divided by the share's
  /// complement, so pass_through + reflected + transmitted + absorbed = 1.
  virtual Rgb pass_through(const SurfacePoint& /*at*/, Vec3 /*wo*/) const { return Rgb(0); }

  /// If the smooth lobes are exactly reflectance / pi on wo's side, that reflectance; else empty.
  /// Lets density estimation sum flux once instead of calling f per photon.
  virtual std::optional<Rgb> lambertian(const SurfacePoint& /*at*/, Vec3 /*wo*/) const {
    return std::nullopt;
  }

  /// f [sr^-1] of the diffuse lobe under a coat, which is a product of what wo and what wi has;
  /// empty if there is none on wo's side. Lets pixels share what arrives under their coat.
  virtual std::optional<Rgb> coated_base(const SurfacePoint& /*at*/, Vec3 /*wo*/,
                                         Vec3 /*wi*/) const {
    return std::nullopt;
  }

  Lobes lobes() const { return lobes_; }
  bool has(Lobes kinds) const { return any(lobes_ & kinds); }
  /// Do smooth lobes scatter light through the surface (rough glass)?
  bool smooth_transmission() const { return smooth_transmission_; }
  /// May pass_through be non-zero?
  bool passes_light() const { return passes_light_; }
  /// Does it look at the surface's tangents? Then SurfacePoint::dp_du and dp_dv must be set, and
  /// the local x axis is along dp_du.
  bool needs_tangents() const { return needs_tangents_; }

 protected:
  explicit Bsdf(Lobes lobes, bool smooth_transmission = false, bool passes_light = false,
                bool needs_tangents = false)
      : lobes_(lobes),
        smooth_transmission_(smooth_transmission),
        passes_light_(passes_light),
        needs_tangents_(needs_tangents) {}

 private:
  Lobes lobes_;
  bool smooth_transmission_;
  bool passes_light_;
  bool needs_tangents_;
};

/// The kind a microfacet lobe of roughness `alpha` (its smaller one if anisotropic) belongs to.
constexpr Lobes microfacet_lobe(float alpha) {
  return alpha < kNearSpecularAlpha ? Lobes::near_specular : Lobes::smooth;
}

}  // namespace octolux
