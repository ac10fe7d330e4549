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
      : diffuse_(config.diffuse), specular_(config.specular), albedo_(schlick_albedo(microfacet)) {
    mean_full_ = albedo_.full.diffuse_mean();
    mean_grazing_ = albedo_.grazing.diffuse_mean();
  }

  Rgb coat(const SurfacePoint& at, float cos_m) const {
    const Ends ends = ends_of(specular_(at.uv));
    return ends.f0 + (Rgb(ends.f90) - ends.f0) * schlick_weight(cos_m);
  }

  Rgb base(const SurfacePoint& at, float cos_o, float cos_i) const {
    const Ends ends = ends_of(specular_(at.uv));
    const Rgb rest = Rgb(1) - mean_coat(ends);
    const Rgb scale{rest.r > 0 ? 1 / rest.r : 0, rest.g > 0 ? 1 / rest.g : 0,
                    rest.b > 0 ? 1 / rest.b : 0};
    return diffuse_(at.uv) * scale * kInvPi * below_coat(ends, cos_o) * below_coat(ends, cos_i);
  }

  float coat_share(const SurfacePoint& at, float cos_o) const {
    const Rgb below = below_coat(ends_of(specular_(at.uv)), cos_o);
    const float specular = mean(Rgb(1) - below);
    const float diffuse = mean(below * diffuse_.mean());
    return specular + diffuse > 0 ? specular / (specular + diffuse) : 1;
  }

  Rgb albedo(const SurfacePoint& at) const {
    const Rgb coat = mean_coat(ends_of(specular_(at.uv)));
    return coat + (Rgb(1) - coat) * diffuse_(at.uv);
  }

 private:
  /// Reflectance at normal and at grazing incidence. No dielectric reflects less than 2 % at normal
  /// incidence: a darker Ks means a dull surface, whose rim must not light up either (Lagarde &
  /// de Rousiers 2014, 3.1).
  struct Ends {
    Rgb f0;
    float f90;
  };
  static Ends ends_of(Rgb specular) {
    const Rgb f0 = clamp_unit(specular);
    return {f0, std::min(1.0f, 50 * max_component(f0))};
  }

  static Rgb coat_albedo(const Ends& ends, float full, float grazing) {
    return clamp_unit(ends.f0 * full + (Rgb(ends.f90) - ends.f0) * grazing);
  }
  /// Hemispherical albedo of the coat.
  Rgb mean_coat(const Ends& ends) const { return coat_albedo(ends, mean_full_, mean_grazing_); }
  Rgb below_coat(const Ends& ends, float cosine) const {
    return Rgb(1) - coat_albedo(ends, albedo_.full(cosine), albedo_.grazing(cosine));
  }

  Color diffuse_, specular_;
  SchlickAlbedo albedo_;
  float mean_full_, mean_grazing_;  // over all directions
};

}  // namespace

std::unique_ptr<Bsdf> make_glossy(const GlossyConfig& config) {
  if (config.specular.is_constant() && is_black(config.specular.mean())) {
    return make_diffuse(config.diffuse);
  }
  const Microfacet microfacet(MicrofacetKind::ggx, config.alpha, config.alpha);
  return std::make_unique<RoughCoat<GlossyModel>>(GlossyModel(config, microfacet), microfacet,
                                                  microfacet_lobe(config.alpha),
                                                  is_black(config.diffuse.mean()));
}

}  // namespace octolux
