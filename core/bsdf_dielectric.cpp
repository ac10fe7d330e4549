// Smooth glass: a boundary between two dielectrics, and a thin pane made of two parallel ones
// (G. G. Stokes 1862: of all the internal reflections together R' = 2 R / (1 + R) comes back and
// the rest goes straight on). Semantics of Mitsuba's `dielectric` and `thindielectric`.
#include "core/bsdf_delta.h"
#include "core/bsdf_makers.h"
#include "core/fresnel.h"

namespace octolux {
namespace {

class Dielectric final : public DeltaBsdf {
 public:
  explicit Dielectric(const DielectricConfig& config) : config_(config) {}

  std::optional<BsdfSample> sample(const SurfacePoint&, Vec3 wo, float u_lobe, Vec2, Lobes lobes,
                                   Carried carried) const override {
    if (wo.z == 0 || !any(lobes & Lobes::delta)) return std::nullopt;
    const DielectricFresnel fresnel = fresnel_dielectric(wo.z, config_.eta);
    const float reflectance = fresnel.reflectance;
    if (u_lobe < reflectance) {
      return delta_sample(reflect(wo), config_.specular_reflectance, reflectance);
    }
    // Radiance from the other side is that times (index here / index there)^2.
    const float compression = carried == Carried::radiance ? 1 / (fresnel.eta * fresnel.eta) : 1.0f;
    return delta_sample(refract(wo, fresnel), config_.specular_transmittance * compression,
                        1 - reflectance, fresnel.eta);
  }

  Rgb albedo(const SurfacePoint&) const override {
    const float r = fresnel_dielectric(1, config_.eta).reflectance;
    return config_.specular_reflectance * r + config_.specular_transmittance * (1 - r);
  }

 private:
  DielectricConfig config_;
};

class ThinDielectric final : public DeltaBsdf {
 public:
  explicit ThinDielectric(const DielectricConfig& config) : DeltaBsdf(true), config_(config) {}

  std::optional<BsdfSample> sample(const SurfacePoint&, Vec3 wo, float, Vec2, Lobes lobes,
                                   Carried) const override {
    if (wo.z == 0 || !any(lobes & Lobes::delta)) return std::nullopt;
    return delta_sample(reflect(wo), config_.specular_reflectance * reflectance(wo.z), 1);
  }

  Rgb pass_through(const SurfacePoint&, Vec3 wo) const override {
    return config_.specular_transmittance * (1 - reflectance(wo.z));
  }

  Rgb albedo(const SurfacePoint&) const override {
    return config_.specular_reflectance * reflectance(1);
  }

 private:
  float reflectance(float cosine) const {
    const float r = fresnel_dielectric(std::abs(cosine), config_.eta).reflectance;
    return 2 * r / (1 + r);
  }

  DielectricConfig config_;
};

}  // namespace

std::unique_ptr<Bsdf> make_dielectric(const DielectricConfig& config) {
  return std::make_unique<Dielectric>(config);
}

std::unique_ptr<Bsdf> make_thin_dielectric(const DielectricConfig& config) {
  return std::make_unique<ThinDielectric>(config);
}

}  // namespace octolux
