// Metals: smooth (a mirror with the Fresnel reflectance of a complex index) and rough (Walter et
// al., EGSR 2007, reflection only; anisotropic). One-sided. Semantics of Mitsuba's `conductor` and
// `roughconductor` with visible normals.
#include "core/bsdf_delta.h"
#include "core/bsdf_makers.h"
#include "core/fresnel.h"
#include "core/microfacet.h"

namespace octolux {
namespace {

class Conductor final : public DeltaBsdf {
 public:
  explicit Conductor(const ConductorConfig& config) : config_(config) {}

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float, Vec2, Lobes lobes,
                                   Carried) const override {
    if (wo.z <= 0 || !any(lobes & Lobes::delta)) return std::nullopt;
    const Rgb fresnel = fresnel_conductor(wo.z, config_.eta, config_.k);
    return delta_sample(reflect(wo), config_.specular_reflectance(at.uv) * fresnel, 1);
  }

  Rgb albedo(const SurfacePoint& at) const override {
    return config_.specular_reflectance(at.uv) * fresnel_conductor(1, config_.eta, config_.k);
  }

 private:
  ConductorConfig config_;
};

class RoughConductor final : public Bsdf {
 public:
  explicit RoughConductor(const RoughConductorConfig& config)
      : Bsdf(config.roughness.lobe(), false, false, !config.roughness.isotropic()),
        conductor_(config.conductor),
        roughness_(config.roughness) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes lobes, Carried) const override {
    if (wo.z <= 0 || wi.z <= 0 || !has(lobes)) return Rgb(0);
    const Microfacet::Reflection r = roughness_.at(at.uv).reflection(wo, wi);
    return reflectance(at, r.cos_m) * r.f;
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes lobes) const override {
    if (wo.z <= 0 || wi.z <= 0 || !has(lobes)) return 0;
    return roughness_.at(at.uv).reflected_pdf_w(wo, normalize(wo + wi));
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float, Vec2 u, Lobes asked,
                                   Carried) const override {
    if (wo.z <= 0 || !has(asked)) return std::nullopt;
    const Microfacet microfacet = roughness_.at(at.uv);
    const Vec3 m = microfacet.sample_visible(wo, u);
    const Vec3 wi = reflect(wo, m);
    if (wi.z <= 0) return std::nullopt;
    const float pdf_w = microfacet.reflected_pdf_w(wo, m);
    const Rgb weight = reflectance(at, dot(wo, m)) * microfacet.g1(wi, m);
    if (pdf_w <= 0 || is_black(weight)) return std::nullopt;
    return BsdfSample{wi, weight, pdf_w, lobes(), 1};
  }

  Rgb albedo(const SurfacePoint& at) const override { return reflectance(at, 1); }

 private:
  Rgb reflectance(const SurfacePoint& at, float cosine) const {
    return conductor_.specular_reflectance(at.uv) *
           fresnel_conductor(cosine, conductor_.eta, conductor_.k);
  }

  ConductorConfig conductor_;
  Roughness roughness_;
};

}  // namespace

std::unique_ptr<Bsdf> make_conductor(const ConductorConfig& config) {
  return std::make_unique<Conductor>(config);
}

std::unique_ptr<Bsdf> make_rough_conductor(const RoughConductorConfig& config) {
  return std::make_unique<RoughConductor>(config);
}

}  // namespace octolux
