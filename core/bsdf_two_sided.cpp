// One BSDF for the front of a surface and one for its back, each used as if it were a front.
// Mitsuba's `twosided`.
#include "core/bsdf_adapters.h"

namespace octolux {
namespace {

constexpr Vec3 flip(Vec3 w) { return {w.x, w.y, -w.z}; }

class TwoSided final : public Bsdf {
 public:
  TwoSided(const Bsdf& front, const Bsdf& back)
      : Bsdf(front.lobes() | back.lobes(), false, front.passes_light() || back.passes_light(),
             front.needs_tangents() || back.needs_tangents()),
        front_(front),
        back_(back) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried carried) const override {
    if (wo.z > 0) return front_.f(at, wo, wi, asked, carried);
    return back_.f(at, flip(wo), flip(wi), asked, carried);
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const override {
    if (wo.z > 0) return front_.pdf_w(at, wo, wi, asked);
    return back_.pdf_w(at, flip(wo), flip(wi), asked);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    if (wo.z > 0) return front_.sample(at, wo, u_lobe, u, asked, carried);
    std::optional<BsdfSample> s = back_.sample(at, flip(wo), u_lobe, u, asked, carried);
    if (s) s->wi = flip(s->wi);
    return s;
  }

  Rgb albedo(const SurfacePoint& at) const override { return front_.albedo(at); }

  Rgb pass_through(const SurfacePoint& at, Vec3 wo) const override {
    return wo.z > 0 ? front_.pass_through(at, wo) : back_.pass_through(at, flip(wo));
  }

  std::optional<Rgb> lambertian(const SurfacePoint& at, Vec3 wo) const override {
    return wo.z > 0 ? front_.lambertian(at, wo) : back_.lambertian(at, flip(wo));
  }

  std::optional<Rgb> coated_base(const SurfacePoint& at, Vec3 wo, Vec3 wi) const override {
    if (wo.z > 0) return front_.coated_base(at, wo, wi);
    return back_.coated_base(at, flip(wo), flip(wi));
  }

 private:
  const Bsdf& front_;
  const Bsdf& back_;
};

}  // namespace

std::unique_ptr<Bsdf> make_two_sided(const Bsdf& front, const Bsdf& back) {
  return std::make_unique<TwoSided>(front, back);
}

}  // namespace octolux
