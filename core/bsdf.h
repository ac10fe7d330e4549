// How a surface scatters light: the BSDF interface and the makers of every kind we model.
//
// Directions are local: z along the shading normal, `wo` towards the viewer (or where the photon
// came from), `wi` towards where light comes from (or where the photon goes); both leave the
// surface. f is WITHOUT the cosine. A BSDF is a sum of lobes of three kinds, and every call says
// which kinds it asks about, because the light paths of photon mapping are told apart by them
// (DESIGN: S = delta or near-specular, D = everything else).
#pragma once

#include <memory>
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
  /// near-specular and a smooth lobe overlap it carries both; see Scattering::sample_sorted.
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

  Lobes lobes() const { return lobes_; }
  bool has(Lobes kinds) const { return any(lobes_ & kinds); }
  /// Do smooth lobes scatter light through the surface (rough glass)?
  bool smooth_transmission() const { return smooth_transmission_; }
  /// May pass_through be non-zero?
  bool passes_light() const { return passes_light_; }

 protected:
  explicit Bsdf(Lobes lobes, bool smooth_transmission = false, bool passes_light = false)
      : lobes_(lobes), smooth_transmission_(smooth_transmission), passes_light_(passes_light) {}

 private:
  Lobes lobes_;
  bool smooth_transmission_;
  bool passes_light_;
};

/// The kind a microfacet lobe of roughness `alpha` (its smaller one if anisotropic) belongs to.
constexpr Lobes microfacet_lobe(float alpha) {
  return alpha < kNearSpecularAlpha ? Lobes::near_specular : Lobes::smooth;
}

enum class MicrofacetKind { beckmann, ggx };

/// Lambert, front side only (as in Mitsuba); wrap in make_two_sided for both.
std::unique_ptr<Bsdf> make_diffuse(Color reflectance);

struct DielectricConfig {
  float eta = 1.5f / 1.000277f;  // interior index / exterior index
  Rgb specular_reflectance{1, 1, 1};
  Rgb specular_transmittance{1, 1, 1};
};
/// Smooth glass: Fresnel reflection and refraction.
std::unique_ptr<Bsdf> make_dielectric(const DielectricConfig& config);
/// A thin pane with all its internal reflections (Stokes); transmission is pass_through.
std::unique_ptr<Bsdf> make_thin_dielectric(const DielectricConfig& config);

struct RoughDielectricConfig {
  DielectricConfig dielectric;
  MicrofacetKind kind = MicrofacetKind::beckmann;
  float alpha = 0.1f;
};
/// Walter et al., EGSR 2007. `eta` must not be 1: a boundary between equals has no normals.
std::unique_ptr<Bsdf> make_rough_dielectric(const RoughDielectricConfig& config);

struct ConductorConfig {
  Rgb eta{0, 0, 0};  // index of refraction relative to the outside
  Rgb k{1, 1, 1};    // extinction coefficient; eta = 0, k = 1 is a perfect mirror
  Color specular_reflectance{Rgb(1)};
};
std::unique_ptr<Bsdf> make_conductor(const ConductorConfig& config);

struct RoughConductorConfig {
  ConductorConfig conductor;
  MicrofacetKind kind = MicrofacetKind::beckmann;
  float alpha_u = 0.1f;  // along the tangent; equal values are isotropic
  float alpha_v = 0.1f;
};
std::unique_ptr<Bsdf> make_rough_conductor(const RoughConductorConfig& config);

struct PlasticConfig {
  float eta = 1.49f / 1.000277f;
  Color diffuse_reflectance{Rgb(0.5f)};
  Rgb specular_reflectance{1, 1, 1};
  bool nonlinear = false;  // colour shifts by internal scattering
};
/// Mitsuba's `plastic`: a dielectric coat over a diffuse base.
std::unique_ptr<Bsdf> make_plastic(const PlasticConfig& config);

struct RoughPlasticConfig {
  PlasticConfig plastic;
  MicrofacetKind kind = MicrofacetKind::beckmann;
  float alpha = 0.1f;
};
std::unique_ptr<Bsdf> make_rough_plastic(const RoughPlasticConfig& config);

struct GlossyConfig {
  Color diffuse{Rgb(0)};  // Kd
  Rgb specular{0, 0, 0};  // Ks: reflectance at normal incidence
  float alpha = 0.1f;     // GGX
};
/// Wavefront MTL's Kd + Ks + Ns: Lambert under a GGX lobe with Schlick's Fresnel; never reflects
/// more than it receives.
std::unique_ptr<Bsdf> make_glossy(const GlossyConfig& config);

/// `front` seen from the front, `back` (flipped) from behind. Neither may transmit.
std::unique_ptr<Bsdf> make_two_sided(const Bsdf& front, const Bsdf& back);

/// `inner` where opaque; light passes straight on where not.
std::unique_ptr<Bsdf> make_mask(const Bsdf& inner, Color opacity);

}  // namespace octolux
