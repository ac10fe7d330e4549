// Rough glass: reflection and refraction by microfacets (Walter, Marschner, Li & Torrance, EGSR
// 2007), visible normals sampled. Semantics of Mitsuba's `roughdielectric`.
//
// For radiance, f(wo, wi) = (1 - F) D G |wo.m| |wi.m| / (|cos wo| |cos wi| (wo.m + eta wi.m)^2)
// with eta the index on wi's side over that on wo's side: Walter's equation 21 times the 1/eta^2
// that radiance loses (Veach 1997, 5.2). For flux without that factor.
#include "core/bsdf_makers.h"
#include "core/check.h"
#include "core/fresnel.h"
#include "core/microfacet.h"

namespace octolux {
namespace {

class RoughDielectric final : public Bsdf {
 public:
  explicit RoughDielectric(const RoughDielectricConfig& config)
      : Bsdf(config.roughness.lobe(), config.roughness.lobe() == Lobes::smooth, false,
             !config.roughness.isotropic()),
        dielectric_(config.dielectric),
        roughness_(config.roughness) {
    OCTOLUX_CHECK(dielectric_.eta > 0 && dielectric_.eta != 1);  // no boundary has no normals
  }

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes lobes, Carried carried) const override {
    if (wo.z == 0 || wi.z == 0 || !has(lobes)) return Rgb(0);
    const Boundary b = boundary(wo, wi);
    if (!b.visible) return Rgb(0);
    const Microfacet microfacet = roughness_.at(at.uv);
    const float d_g = microfacet.d(b.m) * microfacet.g1(wo, b.m) * microfacet.g1(wi, b.m);
    const float d_g_cos = d_g / std::abs(wo.z * wi.z);
    if (b.reflects) return dielectric_.specular_reflectance * (0.25f * b.reflectance * d_g_cos);
    const float flux = carried == Carried::flux ? b.eta * b.eta : 1.0f;
    const float f = (1 - b.reflectance) * d_g_cos * std::abs(b.wo_m * b.wi_m) / b.compression;
    return dielectric_.specular_transmittance * (flux * f);
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes lobes) const override {
    if (wo.z == 0 || wi.z == 0 || !has(lobes)) return 0;
    const Boundary b = boundary(wo, wi);
    return b.visible ? pdf_w(roughness_.at(at.uv), wo, b) : 0;
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    if (wo.z == 0 || !has(asked)) return std::nullopt;
    const Microfacet microfacet = roughness_.at(at.uv);
    const Vec3 m = microfacet.sample_visible(wo.z > 0 ? wo : -wo, u);
    const float wo_m = dot(wo, m);
    const DielectricFresnel fresnel = fresnel_dielectric(wo_m, dielectric_.eta);
    const bool reflects = u_lobe < fresnel.reflectance;
    const Vec3 wi = reflects ? reflect(wo, m) : refract(wo, m, fresnel);
    const float eta = reflects ? 1 : fresnel.eta;

    const Boundary b = make_boundary(m, wo, wi, eta, fresnel.reflectance, reflects);
    if (!b.visible || (wo.z * wi.z > 0) != reflects) return std::nullopt;
    const float pdf = pdf_w(microfacet, wo, b);
    const float radiance = carried == Carried::radiance ? 1 / (eta * eta) : 1.0f;
    const Rgb colour =
        reflects ? dielectric_.specular_reflectance : dielectric_.specular_transmittance;
    const Rgb weight = colour * (radiance * microfacet.g1(wi, m));
    if (pdf <= 0 || is_black(weight)) return std::nullopt;
    return BsdfSample{wi, weight, pdf, lobes(), eta};
  }

  Rgb albedo(const SurfacePoint&) const override {
    const float r = fresnel_dielectric(1, dielectric_.eta).reflectance;
    return dielectric_.specular_reflectance * r + dielectric_.specular_transmittance * (1 - r);
  }

 private:
  /// The microfacet that takes light between wo and wi.
  struct Boundary {
    Vec3 m;          // on the outside
    float wo_m = 0;  // signed cosines with m
    float wi_m = 0;
    float eta = 1;          // index on wi's side / on wo's side
    float reflectance = 0;  // Fresnel
    float compression = 0;  // (wo.m + eta wi.m)^2
    bool reflects = false;
    bool visible = false;  // is m's same side seen along both directions?
  };

  static Boundary make_boundary(Vec3 m, Vec3 wo, Vec3 wi, float eta, float reflectance,
                                bool reflects) {
    const float wo_m = dot(wo, m);
    const float wi_m = dot(wi, m);
    const float sum = wo_m + eta * wi_m;
    const bool visible = wo_m * wo.z > 0 && wi_m * wi.z > 0;
    return {m, wo_m, wi_m, eta, reflectance, sum * sum, reflects, visible};
  }

  Boundary boundary(Vec3 wo, Vec3 wi) const {
    const bool reflects = wo.z * wi.z > 0;
    const float eta = reflects ? 1 : wo.z > 0 ? dielectric_.eta : 1 / dielectric_.eta;
    const Vec3 half = normalize(wo + wi * eta);
    const Vec3 m = half.z < 0 ? -half : half;
    const float reflectance = fresnel_dielectric(dot(wo, m), dielectric_.eta).reflectance;
    return make_boundary(m, wo, wi, eta, reflectance, reflects);
  }

  /// Density of m, times the choice between reflection and refraction, times dm / dwi.
  static float pdf_w(const Microfacet& microfacet, Vec3 wo, const Boundary& b) {
    const Vec3 above = wo.z > 0 ? wo : -wo;
    const float pdf_m = microfacet.visible_pdf_w(above, b.m);
    if (b.reflects) return pdf_m * b.reflectance / (4 * std::abs(b.wo_m));
    return pdf_m * (1 - b.reflectance) * b.eta * b.eta * std::abs(b.wi_m) / b.compression;
  }

  DielectricConfig dielectric_;
  Roughness roughness_;
};

}  // namespace

std::unique_ptr<Bsdf> make_rough_dielectric(const RoughDielectricConfig& config) {
  return std::make_unique<RoughDielectric>(config);
}

}  // namespace octolux
