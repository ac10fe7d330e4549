// Rough plastic: a rough dielectric coat over a diffuse base. What the base receives and what the
// coat throws back to it are tabulated (microfacet_albedo.h). Semantics of Mitsuba 3's
// `roughplastic`.
#include "core/bsdf_makers.h"
#include "core/bsdf_rough_coat.h"
#include "core/microfacet_albedo.h"

namespace octolux {
namespace {

/// Diffuse reflectance of the coat from inside. It is the plain mean of 2 cos R over the 64 table
/// entries, ends included, which lies about 1.5 % below the integral: that is how Mitsuba defines
/// the material's colour, and its users' scenes are tuned to it.
float internal_reflectance(const CosineTable& reflectance) {
  double sum = 0;
  for (int i = 0; i < CosineTable::kSize; ++i) sum += reflectance[i] * CosineTable::cosine(i);
  return static_cast<float>(2 * sum / CosineTable::kSize);
}

class PlasticModel {
 public:
  PlasticModel(const PlasticConfig& config, const Microfacet& microfacet)
      : config_(config),
        transmittance_(rough_transmittance(microfacet, config.eta)),
        internal_(internal_reflectance(rough_reflectance(microfacet, 1 / config.eta))) {
    const float diffuse = mean(config.diffuse_reflectance.mean());
    const float specular = mean(config.specular_reflectance);
    specular_weight_ = diffuse + specular > 0 ? specular / (diffuse + specular) : 1;
  }

  Rgb coat(const SurfacePoint&, float cos_m) const {
    return config_.specular_reflectance * fresnel_dielectric(cos_m, config_.eta).reflectance;
  }

  Rgb base(const SurfacePoint& at, float cos_o, float cos_i) const {
    return reflectance(at) * (kInvPi * transmittance_(cos_o) * transmittance_(cos_i));
  }

  float coat_share(const SurfacePoint&, float cos_o) const {
    const float t = transmittance_(cos_o);
    const float specular = (1 - t) * specular_weight_;
    const float diffuse = t * (1 - specular_weight_);
    return specular / (specular + diffuse);
  }

  Rgb albedo(const SurfacePoint& at) const {
    const float t = transmittance_.diffuse_mean();
    return config_.specular_reflectance * (1 - t) + reflectance(at) * (t * t);
  }

 private:
  /// As in `plastic`: with what the coat throws back, over eta^2.
  Rgb reflectance(const SurfacePoint& at) const {
    const Rgb diffuse = config_.diffuse_reflectance(at.uv);
    const Rgb returned = config_.nonlinear ? diffuse * internal_ : Rgb(internal_);
    return diffuse / ((Rgb(1) - returned) * (config_.eta * config_.eta));
  }

  PlasticConfig config_;
  CosineTable transmittance_;
  float internal_;
  float specular_weight_ = 1;
};

}  // namespace

std::unique_ptr<Bsdf> make_rough_plastic(const RoughPlasticConfig& config) {
  const Microfacet microfacet(config.kind, config.alpha, config.alpha);
  const bool black_base = is_black(config.plastic.diffuse_reflectance.mean());
  return std::make_unique<RoughCoat<PlasticModel>>(PlasticModel(config.plastic, microfacet),
                                                   microfacet, microfacet_lobe(config.alpha),
                                                   black_base);
}

}  // namespace octolux
