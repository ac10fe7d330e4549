// Lambert and the modified Phong lobe (Lafortune & Willems, "Using the Modified Phong Reflectance
// Model for Physically Based Rendering", 1994): f = kd / pi + ks (n + 2) / (2 pi) cos^n(wi, mirror
// direction of wo). Reciprocal; one-sided; semantics of Mitsuba 0.6's `phong`.
#include <cmath>

#include "core/bsdf_makers.h"
#include "core/constants.h"
#include "core/frame.h"
#include "core/fresnel.h"
#include "core/sampling.h"

namespace octolux {
namespace {

/// The lobe is about as wide as that of microfacets with this roughness (Walter et al. 2007).
Lobes lobe_kind(const PhongConfig& config) {
  return microfacet_lobe(std::sqrt(2 / (config.exponent.mean() + 2)));
}

class Phong final : public Bsdf {
 public:
  explicit Phong(const PhongConfig& config)
      : Bsdf((is_black(config.diffuse_reflectance.mean()) ? Lobes::none : Lobes::smooth) |
             (is_black(config.specular_reflectance.mean()) ? Lobes::none : lobe_kind(config))),
        config_(config),
        lobe_(lobe_kind(config)) {
    const float diffuse = mean(config.diffuse_reflectance.mean());
    const float specular = mean(config.specular_reflectance.mean());
    specular_share_ = specular > 0 ? specular / (diffuse + specular) : 0;
  }

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried) const override {
    if (wo.z <= 0 || wi.z <= 0) return Rgb(0);
    const Rgb kd = config_.diffuse_reflectance(at.uv), ks = config_.specular_reflectance(at.uv);
    Rgb sum(0);
    if (diffuse_asked(asked)) sum += kd * kInvPi;
    if (specular_asked(asked)) {
      const float n = config_.exponent(at.uv);
      sum += ks * ((n + 2) * 0.5f * kInvPi * power(wo, wi, n));
    }
    return sum / std::max(1.0f, max_component(kd + ks));
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const override {
    if (wo.z <= 0 || wi.z <= 0) return 0;
    const float p = specular_probability(asked);
    const float n = config_.exponent(at.uv);
    float pdf = 0;
    if (specular_asked(asked)) pdf += p * (n + 1) * 0.5f * kInvPi * power(wo, wi, n);
    if (diffuse_asked(asked)) pdf += (1 - p) * wi.z * kInvPi;
    return pdf;
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    if (wo.z <= 0 || (!diffuse_asked(asked) && !specular_asked(asked))) return std::nullopt;
    const bool specular = u_lobe < specular_probability(asked);
    const Vec3 wi =
        specular ? sample_lobe(wo, config_.exponent(at.uv), u) : sample_cosine_hemisphere(u);
    const float pdf = pdf_w(at, wo, wi, asked);
    if (wi.z <= 0 || !(pdf > 0)) return std::nullopt;
    const Rgb weight = f(at, wo, wi, asked, carried) * (wi.z / pdf);
    if (is_black(weight)) return std::nullopt;
    return BsdfSample{wi, weight, pdf, specular ? lobe_ : Lobes::smooth, 1};
  }

  Rgb albedo(const SurfacePoint& at) const override {
    const Rgb sum = config_.diffuse_reflectance(at.uv) + config_.specular_reflectance(at.uv);
    return sum / std::max(1.0f, max_component(sum));
  }

 private:
  bool diffuse_asked(Lobes asked) const {
    return any(asked & Lobes::smooth) && specular_share_ < 1;
  }
  bool specular_asked(Lobes asked) const { return any(asked & lobe_) && specular_share_ > 0; }
  float specular_probability(Lobes asked) const {
    if (!specular_asked(asked)) return 0;
    return diffuse_asked(asked) ? specular_share_ : 1.0f;
  }

  static float power(Vec3 wo, Vec3 wi, float exponent) {
    const float cosine = dot(reflect(wo), wi);
    return cosine > 0 ? std::pow(std::min(cosine, 1.0f), exponent) : 0;
  }

  static Vec3 sample_lobe(Vec3 wo, float exponent, Vec2 u) {
    const float cosine = std::pow(1 - u.x, 1 / (exponent + 1));
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    const float phi = 2 * kPi * u.y;
    const Vec3 w{sine * std::cos(phi), sine * std::sin(phi), cosine};
    return normalize(Frame::from_normal(reflect(wo)).to_world(w));
  }

  PhongConfig config_;
  Lobes lobe_;
  float specular_share_ = 0;
};

}  // namespace

std::unique_ptr<Bsdf> make_phong(const PhongConfig& config) {
  return std::make_unique<Phong>(config);
}

}  // namespace octolux
