// Every kind of surface we model: its parameters, and the function that makes its BSDF. Each kind
// is implemented in a file of its own, core/bsdf_<kind>.cpp, and seen through core/bsdf.h only.
#pragma once

#include <memory>

#include "core/bsdf.h"
#include "core/microfacet.h"

namespace octolux {

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
