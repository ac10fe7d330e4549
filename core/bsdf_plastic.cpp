// Smooth plastic: a dielectric coat over a diffuse base, with all internal reflections between the
// two. Semantics of Mitsuba's `plastic`.
#include "core/bsdf_makers.h"
#include "core/constants.h"
#include "core/fresnel.h"
#include "core/sampling.h"

namespace octolux {
namespace {

/// A black base is no lobe at all.
Lobes base_kind(const Color& diffuse) {
  return is_black(diffuse.mean()) ? Lobes::none : Lobes::smooth;
}

class Plastic final : public Bsdf {
 public:
  explicit Plastic(const PlasticConfig& config)
      : Bsdf(Lobes::delta | base_kind(config.diffuse_reflectance)),
        config_(config),
        internal_(fresnel_diffuse_reflectance(1 / config.eta)) {
    const float diffuse = mean(config.diffuse_reflectance.mean());
    const float specular = mean(config.specular_reflectance);
    specular_weight_ = diffuse + specular > 0 ? specular / (diffuse + specular) : 1;
  }

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried) const override {
    if (wo.z <= 0 || wi.z <= 0 || !base_asked(asked)) return Rgb(0);
    return base(at) * (kInvPi * transmittance(wo.z) * transmittance(wi.z));
  }

  float pdf_w(const SurfacePoint&, Vec3 wo, Vec3 wi, Lobes asked) const override {
    if (wo.z <= 0 || !base_asked(asked)) return 0;
    return (1 - specular_probability(wo.z, asked)) * cosine_hemisphere_pdf_w(wi);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried) const override {
    if (wo.z <= 0 || !has(asked)) return std::nullopt;
    const float p = specular_probability(wo.z, asked);
    if (u_lobe < p) {
      const Rgb weight = config_.specular_reflectance * ((1 - transmittance(wo.z)) / p);
      if (is_black(weight)) return std::nullopt;
      return BsdfSample{reflect(wo), weight, p, Lobes::delta, 1};
    }
    if (!base_asked(asked)) return std::nullopt;
    const Vec3 wi = sample_cosine_hemisphere(u);
    const Rgb weight = base(at) * (transmittance(wo.z) * transmittance(wi.z) / (1 - p));
    if (is_black(weight)) return std::nullopt;
    return BsdfSample{wi, weight, (1 - p) * wi.z * kInvPi, Lobes::smooth, 1};
  }

  Rgb albedo(const SurfacePoint& at) const override {
    const float external = fresnel_diffuse_reflectance(config_.eta);
    const float in_out = (1 - external) * (1 - external);
    return config_.specular_reflectance * external + base(at) * in_out;
  }

  std::optional<Rgb> coated_base(const SurfacePoint& at, Vec3 wo, Vec3 wi) const override {
    if (!has(Lobes::smooth)) return std::nullopt;
    return f(at, wo, wi, Lobes::smooth, Carried::radiance);
  }

 private:
  bool base_asked(Lobes asked) const { return any(asked & lobes() & Lobes::smooth); }

  float transmittance(float cosine) const {
    return 1 - fresnel_dielectric(cosine, config_.eta).reflectance;
  }

  /// Reflectance of the base with what the coat throws back to it, over eta^2: the solid angle
  /// that light spreads into when it leaves.
  Rgb base(const SurfacePoint& at) const {
    const Rgb diffuse = config_.diffuse_reflectance(at.uv);
    const Rgb returned = config_.nonlinear ? diffuse * internal_ : Rgb(internal_);
    return diffuse / ((Rgb(1) - returned) * (config_.eta * config_.eta));
  }

  float specular_probability(float cosine, Lobes asked) const {
    if (!base_asked(asked)) return 1;
    if (!any(asked & Lobes::delta)) return 0;
    const float t = transmittance(cosine);
    const float specular = (1 - t) * specular_weight_;
    const float diffuse = t * (1 - specular_weight_);
    return specular / (specular + diffuse);
  }

  PlasticConfig config_;
  float internal_;  // reflectance of the coat for diffuse light from inside
  float specular_weight_ = 1;
};

}  // namespace

std::unique_ptr<Bsdf> make_plastic(const PlasticConfig& config) {
  return std::make_unique<Plastic>(config);
}

}  // namespace octolux
