// Cut-outs: a BSDF where a texture is opaque, nothing where it is not, a share of both in between.
// Mitsuba's `mask`; opacity may differ between the channels. And nothing everywhere, its `null`.
#include <algorithm>

#include "core/bsdf_adapters.h"
#include "core/bsdf_makers.h"

namespace octolux {
namespace {

class Mask final : public Bsdf {
 public:
  Mask(const Bsdf& inner, Color opacity)
      : Bsdf(inner.lobes(), inner.smooth_transmission(), true, inner.needs_tangents()),
        inner_(inner),
        opacity_(opacity) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried carried) const override {
    return inner_.f(at, wo, wi, asked, carried) * opacity(at);
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const override {
    return is_black(opacity(at)) ? 0 : inner_.pdf_w(at, wo, wi, asked);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    const Rgb share = opacity(at);
    if (is_black(share)) return std::nullopt;
    std::optional<BsdfSample> s = inner_.sample(at, wo, u_lobe, u, asked, carried);
    if (!s) return s;
    s->weight *= share;
    return is_black(s->weight) ? std::nullopt : s;
  }

  Rgb albedo(const SurfacePoint& at) const override { return inner_.albedo(at) * opacity(at); }

  Rgb pass_through(const SurfacePoint& at, Vec3 wo) const override {
    const Rgb share = opacity(at);
    return Rgb(1) - share + share * inner_.pass_through(at, wo);
  }

  std::optional<Rgb> lambertian(const SurfacePoint& at, Vec3 wo) const override {
    std::optional<Rgb> reflectance = inner_.lambertian(at, wo);
    if (reflectance) *reflectance *= opacity(at);
    return reflectance;
  }

 private:
  Rgb opacity(const SurfacePoint& at) const {
    const Rgb o = opacity_(at.uv);
    return {std::clamp(o.r, 0.0f, 1.0f), std::clamp(o.g, 0.0f, 1.0f), std::clamp(o.b, 0.0f, 1.0f)};
  }

  const Bsdf& inner_;
  Color opacity_;
};

class Null final : public Bsdf {
 public:
  Null() : Bsdf(Lobes::none, false, true) {}

  Rgb f(const SurfacePoint&, Vec3, Vec3, Lobes, Carried) const override { return Rgb(0); }
  float pdf_w(const SurfacePoint&, Vec3, Vec3, Lobes) const override { return 0; }
  std::optional<BsdfSample> sample(const SurfacePoint&, Vec3, float, Vec2, Lobes,
                                   Carried) const override {
    return std::nullopt;
  }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(0); }
  Rgb pass_through(const SurfacePoint&, Vec3) const override { return Rgb(1); }
};

}  // namespace

std::unique_ptr<Bsdf> make_null() { return std::make_unique<Null>(); }

std::unique_ptr<Bsdf> make_mask(const Bsdf& inner, Color opacity) {
  return std::make_unique<Mask>(inner, opacity);
}

}  // namespace octolux
