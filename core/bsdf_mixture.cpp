// Sums of BSDFs: Mitsuba's `blendbsdf` (two, by a texture) and `mixturebsdf` (any number, by
// constants). A component is chosen in proportion to its weight among those that have the kinds of
// lobes asked for; what is not delta carries the density and the value of all of them.
#include <cmath>
#include <vector>

#include "core/bsdf_adapters.h"
#include "core/constants.h"

namespace octolux {
namespace {

struct Traits {
  Lobes lobes = Lobes::none;
  bool smooth_transmission = false, passes_light = false, needs_tangents = false;
};

Traits traits_of(std::span<const WeightedBsdf> parts) {
  Traits t;
  for (const WeightedBsdf& part : parts) {
    t.lobes = t.lobes | part.bsdf->lobes();
    t.smooth_transmission |= part.bsdf->smooth_transmission();
    t.passes_light |= part.bsdf->passes_light();
    t.needs_tangents |= part.bsdf->needs_tangents();
  }
  return t;
}

class Mixture final : public Bsdf {
 public:
  /// With `blend`, the weights of the two parts are 1 - blend and blend.
  Mixture(std::span<const WeightedBsdf> parts, std::optional<Scalar> blend, const Traits& t)
      : Bsdf(t.lobes, t.smooth_transmission, t.passes_light, t.needs_tangents),
        parts_(parts.begin(), parts.end()),
        blend_(blend) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried carried) const override {
    Rgb sum(0);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const float w = weight(i, at);
      if (w > 0) sum += parts_[i].bsdf->f(at, wo, wi, asked, carried) * w;
    }
    return sum;
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const override {
    float sum = 0, total = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const float w = asked_weight(i, at, asked);
      if (w > 0) sum += parts_[i].bsdf->pdf_w(at, wo, wi, asked) * w;
      total += w;
    }
    return total > 0 ? sum / total : 0;
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    float total = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) total += asked_weight(i, at, asked);
    float left = u_lobe * total;
    std::size_t chosen = 0;
    while (chosen + 1 < parts_.size() && left >= asked_weight(chosen, at, asked)) {
      left -= asked_weight(chosen++, at, asked);
    }
    const float share = asked_weight(chosen, at, asked);
    if (!(share > 0)) return std::nullopt;
    const float u_inner = std::min(kOneMinusEpsilon, left / share);
    std::optional<BsdfSample> s = parts_[chosen].bsdf->sample(at, wo, u_inner, u, asked, carried);
    if (!s) return s;
    if (s->lobe == Lobes::delta) {
      s->weight *= total;
      s->pdf_w *= share / total;
      return s;
    }
    s->pdf_w = pdf_w(at, wo, s->wi, asked);
    if (!(s->pdf_w > 0)) return std::nullopt;
    s->weight = f(at, wo, s->wi, asked, carried) * (std::abs(s->wi.z) / s->pdf_w);
    return is_black(s->weight) ? std::nullopt : s;
  }

  Rgb albedo(const SurfacePoint& at) const override {
    Rgb sum(0);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      sum += parts_[i].bsdf->albedo(at) * weight(i, at);
    }
    return sum;
  }

  Rgb pass_through(const SurfacePoint& at, Vec3 wo) const override {
    Rgb sum(0);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      sum += parts_[i].bsdf->pass_through(at, wo) * weight(i, at);
    }
    return sum;
  }

  std::optional<Rgb> lambertian(const SurfacePoint& at, Vec3 wo) const override {
    Rgb sum(0);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const std::optional<Rgb> part = parts_[i].bsdf->lambertian(at, wo);
      if (!part) return part;
      sum += *part * weight(i, at);
    }
    return sum;
  }

 private:
  float weight(std::size_t i, const SurfacePoint& at) const {
    if (!blend_) return parts_[i].weight;
    const float w = std::clamp((*blend_)(at.uv), 0.0f, 1.0f);
    return i == 0 ? 1 - w : w;
  }
  float asked_weight(std::size_t i, const SurfacePoint& at, Lobes asked) const {
    return parts_[i].bsdf->has(asked) ? weight(i, at) : 0;
  }

  std::vector<WeightedBsdf> parts_;
  std::optional<Scalar> blend_;
};

}  // namespace

std::unique_ptr<Bsdf> make_blend(const Bsdf& first, const Bsdf& second, Scalar weight) {
  const WeightedBsdf parts[] = {{&first, 0.5f}, {&second, 0.5f}};
  return std::make_unique<Mixture>(parts, weight, traits_of(parts));
}

std::unique_ptr<Bsdf> make_mixture(std::span<const WeightedBsdf> parts) {
  return std::make_unique<Mixture>(parts, std::nullopt, traits_of(parts));
}

}  // namespace octolux
