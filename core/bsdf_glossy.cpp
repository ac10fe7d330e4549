// Wavefront MTL's Kd + Ks + Ns made physical: Lambert under a GGX lobe with Schlick's Fresnel. The
// base receives, and lets out, only what the coat does not reflect (Kelemen & Szirmay-Kalos 2001):
// f_base = Kd / pi (1 - E(wo)) (1 - E(wi)) / (1 - mean E), E the coat's directional albedo, so the
// whole is reciprocal and reflects E + (1 - E) Kd <= 1.
#include "core/bsdf_makers.h"
#include "core/bsdf_rough_coat.h"
#include "core/microfacet_albedo.h"

namespace octolux {
namespace {

Rgb clamp_unit(Rgb c) {
  return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

class GlossyModel {
 public:
  GlossyModel(const GlossyConfig& config, const Microfacet& microfacet)
      : diffuse_(config.diffuse), f0_(clamp_unit(config.specular)) {
    // No dielectric reflects less than 2 % at normal incidence: a darker Ks means a dull surface,
    // whose rim must not light up either (Lagarde & de Rousiers 2014, 3.1).
    f90_ = std::min(1.0f, 50 * max_component(f0_));
    albedo_ = schlick_albedo(microfacet);
    mean_coat_ = coat_albedo(albedo_.full.diffuse_mean(), albedo_.grazing.diffuse_mean());
    const Rgb rest = Rgb(1) - mean_coat_;
    base_scale_ = {rest.r > 0 ? 1 / rest.r : 0, rest.g > 0 ? 1 / rest.g : 0,
                   rest.b > 0 ? 1 / rest.b : 0};
  }

  Rgb coat(float cos_m) const { return f0_ + (Rgb(f90_) - f0_) * schlick_weight(cos_m); }

  Rgb base(const SurfacePoint& at, float cos_o, float cos_i) const {
    return diffuse_(at.uv) * base_scale_ * kInvPi * below_coat(cos_o) * below_coat(cos_i);
  }

  float coat_share(float cos_o) const {
    const Rgb below = below_coat(cos_o);
    const float specular = mean(Rgb(1) - below);
    const float diffuse = mean(below * diffuse_.mean());
    return specular + diffuse > 0 ? specular / (specular + diffuse) : 1;
  }

  Rgb albedo(const SurfacePoint& at) const {
    return mean_coat_ + (Rgb(1) - mean_coat_) * diffuse_(at.uv);
  }

 private:
  Rgb coat_albedo(float full, float grazing) const {
    return clamp_unit(f0_ * full + (Rgb(f90_) - f0_) * grazing);
  }
  Rgb below_coat(float cosine) const {
    return Rgb(1) - coat_albedo(albedo_.full(cosine), albedo_.grazing(cosine));
  }

  Color diffuse_;
  Rgb f0_;
  float f90_;
  SchlickAlbedo albedo_;
  Rgb mean_coat_;   // hemispherical albedo of the coat
  Rgb base_scale_;  // 1 / (1 - mean_coat_)
};

}  // namespace

std::unique_ptr<Bsdf> make_glossy(const GlossyConfig& config) {
  if (is_black(config.specular)) return make_diffuse(config.diffuse);
  const Microfacet microfacet(MicrofacetKind::ggx, config.alpha, config.alpha);
  return std::make_unique<RoughCoat<GlossyModel>>(GlossyModel(config, microfacet), microfacet,
                                                  microfacet_lobe(config.alpha),
                                                  is_black(config.diffuse.mean()));
}

}  // namespace octolux
