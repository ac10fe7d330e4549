// A smooth dielectric layer over any BSDF: light is refracted into the layer, scattered by what is
// below, and refracted out again; what the layer throws back inside is lost. Mitsuba 0.6's
// `coating` (after Weidlich & Wilkie, "Arbitrarily Layered Micro-Facet Surfaces", GRAPHITE 2007).
//
// f(wo, wi) = T(wo) T(wi) f_inner(wo', wi') / eta^2, primes refracted: symmetric if f_inner is. The
// solid angles compress by d wi' / d wi = cos wi / (eta^2 cos wi').
#include <cmath>

#include "core/bsdf_adapters.h"
#include "core/constants.h"
#include "core/fresnel.h"

namespace octolux {
namespace {

class Coating final : public Bsdf {
 public:
  Coating(const Bsdf& inner, const CoatingConfig& config)
      : Bsdf(inner.lobes() | (is_black(config.specular_reflectance) ? Lobes::none : Lobes::delta),
             inner.smooth_transmission(), inner.passes_light(), inner.needs_tangents()),
        inner_(inner),
        config_(config) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried carried) const override {
    if (wo.z == 0 || wi.z == 0 || !inner_.has(asked)) return Rgb(0);
    const Inside o = enter(wo), i = enter(wi);
    return inner_.f(at, o.w, i.w, asked, carried) * absorbed(at, o.w, i.w) *
           (o.transmitted * i.transmitted / (config_.eta * config_.eta));
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const override {
    if (wo.z == 0 || wi.z == 0 || !inner_.has(asked)) return 0;
    const Inside o = enter(wo), i = enter(wi);
    return (1 - coat_probability(o.transmitted, asked)) * inner_.pdf_w(at, o.w, i.w, asked) *
           compression(wi, i.w);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    if (wo.z == 0 || !has(asked)) return std::nullopt;
    const Inside o = enter(wo);
    const float p = coat_probability(o.transmitted, asked);
    if (u_lobe < p) {
      const Rgb weight = config_.specular_reflectance * ((1 - o.transmitted) / p);
      if (is_black(weight)) return std::nullopt;
      return BsdfSample{reflect(wo), weight, p, Lobes::delta, 1};
    }
    const float u_inner = std::min(kOneMinusEpsilon, (u_lobe - p) / (1 - p));
    std::optional<BsdfSample> s = inner_.sample(at, o.w, u_inner, u, asked, carried);
    if (!s || !leave(*s, at, o)) return std::nullopt;
    s->weight *= 1 / (1 - p);
    s->pdf_w *= 1 - p;
    return is_black(s->weight) ? std::nullopt : s;
  }

  Rgb albedo(const SurfacePoint& at) const override {
    const float r = fresnel_dielectric(1, config_.eta).reflectance;
    const Vec3 up{0, 0, 1};
    return config_.specular_reflectance * r +
           inner_.albedo(at) * absorbed(at, up, up) * ((1 - r) * (1 - r));
  }

  Rgb pass_through(const SurfacePoint& at, Vec3 wo) const override {
    if (wo.z == 0 || !passes_light()) return Rgb(0);
    const Inside o = enter(wo);
    return inner_.pass_through(at, o.w) * absorbed(at, o.w, o.w) * (o.transmitted * o.transmitted);
  }

 private:
  /// A direction as it goes on inside the layer, and the share of light that enters.
  struct Inside {
    Vec3 w;
    float transmitted = 0;
  };
  Inside enter(Vec3 w) const {
    const DielectricFresnel fresnel = fresnel_dielectric(std::abs(w.z), config_.eta);
    const float ratio = 1 / config_.eta;
    const float z = std::sqrt(std::max(0.0f, 1 - (1 - w.z * w.z) * (ratio * ratio)));
    return {{w.x * ratio, w.y * ratio, std::copysign(z, w.z)}, 1 - fresnel.reflectance};
  }

  /// Carries a sample of the inner BSDF out of the layer; false if it is reflected inside.
  bool leave(BsdfSample& s, const SurfacePoint& at, const Inside& o) const {
    const Vec3 inside = s.wi;
    const float cos2 = 1 - config_.eta * config_.eta * (1 - inside.z * inside.z);
    if (!(cos2 > 0)) return false;
    s.wi = {inside.x * config_.eta, inside.y * config_.eta,
            std::copysign(std::sqrt(cos2), inside.z)};
    const float transmitted = 1 - fresnel_dielectric(std::abs(s.wi.z), config_.eta).reflectance;
    s.weight *= absorbed(at, o.w, inside) * (o.transmitted * transmitted);
    if (s.lobe != Lobes::delta) s.pdf_w *= compression(s.wi, inside);
    return true;
  }

  float compression(Vec3 outside, Vec3 inside) const {
    return std::abs(outside.z) / (config_.eta * config_.eta * std::abs(inside.z));
  }

  Rgb absorbed(const SurfacePoint& at, Vec3 o, Vec3 i) const {
    const Rgb sigma = config_.sigma_a(at.uv) * config_.thickness;
    if (is_black(sigma)) return Rgb(1);
    const float way = 1 / std::abs(o.z) + 1 / std::abs(i.z);
    return {std::exp(-sigma.r * way), std::exp(-sigma.g * way), std::exp(-sigma.b * way)};
  }

  float coat_probability(float transmitted, Lobes asked) const {
    if (!any(asked & lobes() & Lobes::delta) || is_black(config_.specular_reflectance)) return 0;
    if (!inner_.has(asked)) return 1;
    const float coat = (1 - transmitted) * mean(config_.specular_reflectance);
    return coat / (coat + transmitted);
  }

  const Bsdf& inner_;
  CoatingConfig config_;
};

}  // namespace

std::unique_ptr<Bsdf> make_coating(const Bsdf& inner, const CoatingConfig& config) {
  return std::make_unique<Coating>(inner, config);
}

}  // namespace octolux
