// Bump maps (Blinn 1978) and normal maps: the inner BSDF in a shading frame that a texture tilts.
// Semantics of Mitsuba's `bumpmap` and `normalmap`.
//
// With n the shading normal and n' the tilted one, an eye path is scattered by
// f' = f_inner |wi.n'| / |wi.n|, so that f' |wi.n| is what the inner BSDF says. Photons need the
// adjoint (Veach 1997, 5.3.2): the roles of wo and wi change. A direction must lie on the same side
// of n and n', otherwise light would leak through the surface.
#include <cmath>

#include "core/bsdf_makers.h"
#include "core/frame.h"

namespace octolux {
namespace {

class Perturbed : public Bsdf {
 public:
  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried carried) const final {
    const Frame tilted = frame(at);
    const Vec3 o = tilted.to_local(wo), i = tilted.to_local(wi);
    if (!same_side(wo, o) || !same_side(wi, i)) return Rgb(0);
    const float ratio = carried == Carried::radiance ? i.z / wi.z : o.z / wo.z;
    return inner_.f(at, o, i, asked, carried) * ratio;
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const final {
    const Frame tilted = frame(at);
    const Vec3 o = tilted.to_local(wo), i = tilted.to_local(wi);
    return same_side(wo, o) && same_side(wi, i) ? inner_.pdf_w(at, o, i, asked) : 0;
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const final {
    const Frame tilted = frame(at);
    const Vec3 o = tilted.to_local(wo);
    if (!same_side(wo, o)) return std::nullopt;
    std::optional<BsdfSample> s = inner_.sample(at, o, u_lobe, u, asked, carried);
    if (!s) return s;
    const Vec3 i = s->wi;
    s->wi = tilted.to_world(i);
    if (!same_side(s->wi, i)) return std::nullopt;
    if (carried == Carried::flux) s->weight *= (o.z / wo.z) * (s->wi.z / i.z);
    return s;
  }

  Rgb albedo(const SurfacePoint& at) const final { return inner_.albedo(at); }
  Rgb pass_through(const SurfacePoint& at, Vec3 wo) const final {
    return inner_.pass_through(at, wo);
  }

 protected:
  explicit Perturbed(const Bsdf& inner)
      : Bsdf(inner.lobes(), inner.smooth_transmission(), inner.passes_light(), true),
        inner_(inner) {}

  /// The tilted normal in the local frame, unit.
  virtual Vec3 normal(const SurfacePoint& at) const = 0;

 private:
  static bool same_side(Vec3 w, Vec3 tilted) { return w.z * tilted.z > 0; }
  Frame frame(const SurfacePoint& at) const { return Frame::from_tangent(normal(at), {1, 0, 0}); }

  const Bsdf& inner_;
};

class BumpMap final : public Perturbed {
 public:
  BumpMap(const Bsdf& inner, Scalar height, float scale)
      : Perturbed(inner), height_(height), scale_(scale) {}

 private:
  /// Of the surface raised by the height along ns; how ns itself turns is ignored, as in Mitsuba.
  Vec3 normal(const SurfacePoint& at) const override {
    const Frame base = Frame::from_tangent(at.ns, at.dp_du);
    const Vec2 slope = height_.gradient(at.uv) * scale_;
    Vec3 du = base.to_local(at.dp_du), dv = base.to_local(at.dp_dv);
    du.z = slope.x;
    dv.z = slope.y;
    const Vec3 n = cross(du, dv);
    const float l = length(n);
    if (!(l > 0) || !std::isfinite(l)) return {0, 0, 1};
    return n * ((dot(n, base.to_local(at.ng)) < 0 ? -1 : 1) / l);
  }

  Scalar height_;
  float scale_;
};

class NormalMap final : public Perturbed {
 public:
  NormalMap(const Bsdf& inner, Color normals) : Perturbed(inner), normals_(normals) {}

 private:
  Vec3 normal(const SurfacePoint& at) const override {
    const Rgb c = normals_(at.uv);
    const Vec3 n{2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1};
    const float l = length(n);
    return l > 0 && n.z > 0 ? n / l : Vec3{0, 0, 1};
  }

  Color normals_;
};

}  // namespace

std::unique_ptr<Bsdf> make_bump_map(const Bsdf& inner, Scalar height, float scale) {
  return std::make_unique<BumpMap>(inner, height, scale);
}

std::unique_ptr<Bsdf> make_normal_map(const Bsdf& inner, Color normals) {
  return std::make_unique<NormalMap>(inner, normals);
}

}  // namespace octolux
