// Every kind of surface we model: its parameters, and the function that makes its BSDF. Each kind
// is implemented in a file of its own, core/bsdf_<kind>.cpp, and seen through core/bsdf.h only.
// Those that change or add up others are in bsdf_adapters.h.
#pragma once

#include <algorithm>
#include <memory>

#include "core/bsdf.h"
#include "core/microfacet.h"

namespace octolux {

/// Lambert, front side only (as in Mitsuba); wrap in make_two_sided for both.
std::unique_ptr<Bsdf> make_diffuse(Color reflectance);

struct RoughDiffuseConfig {
  Color reflectance{Rgb(0.5f)};
  Scalar alpha = 0.2f;       // root mean square slope of the facets, times sqrt(2)
  bool qualitative = false;  // the simpler form of the model
};
/// Oren & Nayar's model, front side only; Mitsuba 0.6's `roughdiffuse`.
std::unique_ptr<Bsdf> make_rough_diffuse(const RoughDiffuseConfig& config);

struct DielectricConfig {
  float eta = 1.5f / 1.000277f;  // interior index / exterior index
  Rgb specular_reflectance{1, 1, 1};
  Rgb specular_transmittance{1, 1, 1};
};
/// Smooth glass: Fresnel reflection and refraction.
std::unique_ptr<Bsdf> make_dielectric(const DielectricConfig& config);
/// A thin pane with all its internal reflections (Stokes); transmission is pass_through.
std::unique_ptr<Bsdf> make_thin_dielectric(const DielectricConfig& config);

/// Microfacets whose roughness may vary over the surface.
struct Roughness {
  MicrofacetKind kind = MicrofacetKind::beckmann;
  Scalar alpha_u = 0.1f;  // along the tangent
  Scalar alpha_v = 0.1f;

  Microfacet at(const TexturePoint& uv) const { return {kind, alpha_u(uv), alpha_v(uv)}; }
  /// By the mean where it varies: a surface is S or D as a whole.
  Lobes lobe() const { return microfacet_lobe(std::min(alpha_u.mean(), alpha_v.mean())); }
  bool isotropic() const {
    return alpha_u.is_constant() && alpha_v.is_constant() && alpha_u.mean() == alpha_v.mean();
  }
};

struct RoughDielectricConfig {
  DielectricConfig dielectric;
  Roughness roughness;
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
  Roughness roughness;
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
  Color diffuse{Rgb(0)};   // Kd
  Color specular{Rgb(0)};  // Ks: reflectance at normal incidence; above 1 counts as 1
  float alpha = 0.1f;      // GGX
};
/// Wavefront MTL's Kd + Ks + Ns: Lambert under a GGX lobe with Schlick's Fresnel; never reflects
/// more than it receives.
std::unique_ptr<Bsdf> make_glossy(const GlossyConfig& config);

struct PhongConfig {
  Color diffuse_reflectance{Rgb(0.5f)};
  Color specular_reflectance{Rgb(0.2f)};
  Scalar exponent = 30;
};
/// Mitsuba's `phong`: Lambert and the modified Phong lobe (Lafortune & Willems 1994), scaled down
/// where the two would reflect more than they receive.
std::unique_ptr<Bsdf> make_phong(const PhongConfig& config);

struct PrincipledConfig {
  Color base_color{Rgb(0.5f)};
  float eta = 1.5f;  // not 1
  Scalar roughness = 0.5f, anisotropic = 0, metallic = 0, spec_trans = 0, spec_tint = 0;
  Scalar clearcoat = 0, clearcoat_gloss = 0, sheen = 0, sheen_tint = 0, flatness = 0;
};
/// Disney's material as in Mitsuba 3's `principled`; all numbers in [0, 1].
std::unique_ptr<Bsdf> make_principled(const PrincipledConfig& config);

struct PrincipledThinConfig {
  Color base_color{Rgb(0.5f)};
  Scalar eta = 1.5f, roughness = 0.5f, anisotropic = 0, spec_trans = 0, spec_tint = 0;
  Scalar sheen = 0, sheen_tint = 0, flatness = 0;
  Scalar diff_trans = 0;  // in [0, 2]: half of it of diffuse light goes through
};
/// Disney's material for thin sheets as in Mitsuba 3's `principledthin`; other numbers in [0, 1].
std::unique_ptr<Bsdf> make_principled_thin(const PrincipledThinConfig& config);

/// No surface at all: light passes straight on. Mitsuba's `null`.
std::unique_ptr<Bsdf> make_null();

}  // namespace octolux
