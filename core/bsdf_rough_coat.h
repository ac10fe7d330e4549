// A microfacet coat over a diffuse base: the part that rough plastic and MTL's glossy material have
// in common, which is choosing between the two lobes and respecting the kinds asked for. One-sided.
//
// Model supplies the physics:
//   Rgb coat(at, float cos_m)                Fresnel reflectance of the coat's microfacets
//   Rgb base(at, float cos_o, float cos_i)   f of the base under the coat [sr^-1]: a product
//                                            of functions of either cosine
//   float coat_share(at, float cos_o)        probability of choosing the coat when both are asked
//   Rgb albedo(at)
#pragma once

#include <algorithm>

#include "core/bsdf.h"
#include "core/constants.h"
#include "core/fresnel.h"
#include "core/microfacet.h"
#include "core/sampling.h"

namespace octolux {

template <class Model>
class RoughCoat final : public Bsdf {
 public:
  /// `black_base`: there is no diffuse lobe.
  RoughCoat(Model model, const Microfacet& microfacet, Lobes coat_kind, bool black_base)
      : Bsdf(coat_kind | (black_base ? Lobes::none : Lobes::smooth)),
        model_(std::move(model)),
        microfacet_(microfacet),
        coat_kind_(coat_kind),
        base_kind_(black_base ? Lobes::none : Lobes::smooth) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried) const override {
    if (wo.z <= 0 || wi.z <= 0) return Rgb(0);
    Rgb sum(0);
    if (any(asked & coat_kind_)) {
      const Microfacet::Reflection r = microfacet_.reflection(wo, wi);
      sum += model_.coat(at, r.cos_m) * r.f;
    }
    if (any(asked & base_kind_)) sum += model_.base(at, wo.z, wi.z);
    return sum;
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const override {
    if (wo.z <= 0 || wi.z <= 0 || !has(asked)) return 0;
    return pdf_w(wo, wi, coat_probability(at, wo.z, asked));
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    if (wo.z <= 0 || !has(asked)) return std::nullopt;
    const float p = coat_probability(at, wo.z, asked);
    const bool coat = u_lobe < p;
    const Vec3 wi =
        coat ? reflect(wo, microfacet_.sample_visible(wo, u)) : sample_cosine_hemisphere(u);
    if (wi.z <= 0) return std::nullopt;
    const float pdf = pdf_w(wo, wi, p);
    if (pdf <= 0) return std::nullopt;
    const Rgb weight = f(at, wo, wi, asked, carried) * (wi.z / pdf);
    if (is_black(weight)) return std::nullopt;
    return BsdfSample{wi, weight, pdf, coat ? coat_kind_ : base_kind_, 1};
  }

  Rgb albedo(const SurfacePoint& at) const override { return model_.albedo(at); }

  std::optional<Rgb> coated_base(const SurfacePoint& at, Vec3 wo, Vec3 wi) const override {
    if (!any(base_kind_)) return std::nullopt;
    return wo.z > 0 && wi.z > 0 ? model_.base(at, wo.z, wi.z) : Rgb(0);
  }

 private:
  float coat_probability(const SurfacePoint& at, float cos_o, Lobes asked) const {
    if (!any(asked & coat_kind_)) return 0;
    return any(asked & base_kind_) ? model_.coat_share(at, cos_o) : 1.0f;
  }

  float pdf_w(Vec3 wo, Vec3 wi, float p) const {
    const float coat = p > 0 ? p * microfacet_.reflected_pdf_w(wo, normalize(wo + wi)) : 0;
    return coat + (1 - p) * wi.z * kInvPi;
  }

  Model model_;
  Microfacet microfacet_;
  Lobes coat_kind_, base_kind_;
};

}  // namespace octolux
