// Oren & Nayar's rough diffuse surface: V-shaped grooves of Lambertian facets with shadowing,
// masking and one interreflection ("Generalization of Lambert's Reflectance Model", SIGGRAPH 1994,
// equations 30 to 32), or its qualitative form (ibid., 4.4). One-sided; semantics of Mitsuba 0.6's
// `roughdiffuse`, which takes the facets' slope as Beckmann's alpha: sigma = alpha / sqrt(2).
#include <algorithm>
#include <cmath>

#include "core/bsdf_makers.h"
#include "core/constants.h"
#include "core/sampling.h"

namespace octolux {
namespace {

float sine(float cosine) { return std::sqrt(std::max(0.0f, 1 - cosine * cosine)); }

/// Two directions on the front side as the model sees them.
struct Angles {
  Angles(Vec3 wo, Vec3 wi)
      : low(std::min(wo.z, wi.z)),
        high(std::max(wo.z, wi.z)),
        sin_alpha(sine(low)),
        sin_beta(sine(high)) {
    const float sines = sin_alpha * sin_beta;
    if (sines > 0) cos_phi = std::clamp((wo.x * wi.x + wo.y * wi.y) / sines, -1.0f, 1.0f);
  }

  float low, high;            // cosines: of alpha, the larger angle from the normal, and of beta
  float sin_alpha, sin_beta;  // their sines
  float cos_phi = 0;          // between the azimuths

  float tan_beta() const { return sin_beta / high; }
};

/// pi f for reflectance `rho`, by the whole model.
Rgb whole(const Angles& a, float sigma2, Rgb rho) {
  const float alpha = std::acos(std::min(a.low, 1.0f)), beta = std::acos(std::min(a.high, 1.0f));
  const float rough = sigma2 / (sigma2 + 0.09f);
  const float beta_share = 2 * kInvPi * beta;
  const float both = 4 * kInvPi * kInvPi * alpha * beta;
  const float masked = a.cos_phi < 0 ? beta_share * beta_share * beta_share : 0;
  const float c1 = 1 - 0.5f * sigma2 / (sigma2 + 0.33f);
  const float c2 = 0.45f * rough * (a.sin_alpha - masked);
  const float c3 = 0.125f * rough * both * both;
  const float tan_mean = (a.sin_alpha + a.sin_beta) / (a.low + a.high);  // of (alpha + beta) / 2
  const float once = c1 + a.cos_phi * c2 * a.tan_beta() + (1 - std::abs(a.cos_phi)) * c3 * tan_mean;
  const float twice = 0.17f * sigma2 / (sigma2 + 0.13f) * (1 - a.cos_phi * beta_share * beta_share);
  return rho * once + rho * rho * twice;
}

/// The same by the qualitative model: no interreflection, no C3.
Rgb qualitative(const Angles& a, float sigma2, Rgb rho) {
  const float flat = 1 - 0.5f * sigma2 / (sigma2 + 0.33f);
  const float rough = 0.45f * sigma2 / (sigma2 + 0.09f);
  return rho * (flat + rough * std::max(a.cos_phi, 0.0f) * a.sin_alpha * a.tan_beta());
}

class RoughDiffuse final : public Bsdf {
 public:
  explicit RoughDiffuse(const RoughDiffuseConfig& config) : Bsdf(Lobes::smooth), config_(config) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes lobes, Carried) const override {
    if (wo.z <= 0 || wi.z <= 0 || !any(lobes & Lobes::smooth)) return Rgb(0);
    const float alpha = config_.alpha(at.uv);
    const float sigma2 = alpha * alpha / 2;
    const Rgb rho = config_.reflectance(at.uv);
    const Angles angles(wo, wi);
    return (config_.qualitative ? qualitative(angles, sigma2, rho) : whole(angles, sigma2, rho)) *
           kInvPi;
  }

  float pdf_w(const SurfacePoint&, Vec3 wo, Vec3 wi, Lobes lobes) const override {
    if (wo.z <= 0 || !any(lobes & Lobes::smooth)) return 0;
    return cosine_hemisphere_pdf_w(wi);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float, Vec2 u, Lobes lobes,
                                   Carried carried) const override {
    if (wo.z <= 0 || !any(lobes & Lobes::smooth)) return std::nullopt;
    const Vec3 wi = sample_cosine_hemisphere(u);
    if (wi.z <= 0) return std::nullopt;
    const Rgb weight = f(at, wo, wi, lobes, carried) * kPi;
    if (is_black(weight)) return std::nullopt;
    return BsdfSample{wi, weight, wi.z * kInvPi, Lobes::smooth, 1};
  }

  Rgb albedo(const SurfacePoint& at) const override { return config_.reflectance(at.uv); }

 private:
  RoughDiffuseConfig config_;
};

}  // namespace

std::unique_ptr<Bsdf> make_rough_diffuse(const RoughDiffuseConfig& config) {
  return std::make_unique<RoughDiffuse>(config);
}

}  // namespace octolux
