// Bump maps (Blinn 1978) and normal maps: the inner BSDF in a shading frame that a texture tilts.
// Semantics of Mitsuba's `bumpmap` and `normalmap`.
//
// With n the shading normal and n' the tilted one, an eye path is scattered by
// f' = f_inner |wi.n'| / |wi.n|, so that f' |wi.n| is what the inner BSDF says. A direction must
// lie on the same side of n and n', otherwise light would leak through the surface. Mitsuba 3 adds
// two repairs: where n' faces away from the viewer it is mirrored about n (after Schuessler et al.,
// "Microfacet-based Normal Mapping", 2017), and light at grazing angles fades (Conty Estevez et
// al., Ray Tracing Gems 2019, ch. 12).
//
// Neither is symmetric. Photons need the adjoint, f*(wo, wi) = f'(wi, wo): for them the viewer is
// at wi (Veach 1997, 5.3.2). As n' then depends on the direction to be drawn, it is drawn from
// either normal, rarely the mirrored one, and weighted by the sum of both densities.
#include <cmath>

#include "core/bsdf_adapters.h"
#include "core/constants.h"
#include "core/frame.h"

namespace octolux {
namespace {

constexpr float kMirroredShare = 0.125f;  // of photons

float tan2(Vec3 w) { return (1 - w.z * w.z) / (w.z * w.z); }
Vec3 mirrored(Vec3 n) { return {-n.x, -n.y, n.z}; }
bool same_side(Vec3 w, Vec3 tilted) { return w.z * tilted.z > 0; }
/// The tilted frame in the local one.
Frame frame_around(Vec3 n) { return Frame::from_tangent(n, {1, 0, 0}); }

class Perturbed : public Bsdf {
 public:
  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried carried) const final {
    const bool eye = carried == Carried::radiance;
    const Frame tilted = frame_around(towards(normal(at), eye ? wo : wi));
    const Vec3 o = tilted.to_local(wo), i = tilted.to_local(wi);
    if (!same_side(wo, o) || !same_side(wi, i)) return Rgb(0);
    const Vec3 light = eye ? wi : wo;
    const float ratio = (eye ? i.z : o.z) / light.z;
    return inner_.f(at, o, i, asked, carried) * (ratio * fade(tilted.n, light));
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const final {
    return pdf_w(frame_around(towards(normal(at), wo)), at, wo, wi, asked);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const final {
    if (carried == Carried::flux && repairs_.mirror) {
      return sample_photon(at, wo, u_lobe, u, asked);
    }
    const Frame tilted = frame_around(towards(normal(at), wo));
    const Vec3 o = tilted.to_local(wo);
    if (!same_side(wo, o)) return std::nullopt;
    std::optional<BsdfSample> s = inner_.sample(at, o, u_lobe, u, asked, carried);
    if (!s) return s;
    const Vec3 i = s->wi;
    s->wi = tilted.to_world(i);
    if (!same_side(s->wi, i)) return std::nullopt;
    const bool eye = carried == Carried::radiance;
    if (!eye) s->weight *= (o.z / wo.z) * (s->wi.z / i.z);
    s->weight *= fade(tilted.n, eye ? s->wi : wo);
    return s;
  }

  Rgb albedo(const SurfacePoint& at) const final { return inner_.albedo(at); }
  Rgb pass_through(const SurfacePoint& at, Vec3 wo) const final {
    return inner_.pass_through(at, wo);
  }

 protected:
  Perturbed(const Bsdf& inner, TiltRepairs repairs)
      : Bsdf(inner.lobes(), inner.smooth_transmission(), inner.passes_light(), true),
        inner_(inner),
        repairs_(repairs) {}

  /// The tilted normal in the local frame, unit.
  virtual Vec3 normal(const SurfacePoint& at) const = 0;

 private:
  Vec3 towards(Vec3 n, Vec3 view) const {
    return repairs_.mirror && view.z * dot(view, n) <= 0 ? mirrored(n) : n;
  }

  float fade(Vec3 n, Vec3 light) const {
    if (!repairs_.fade) return 1;
    const float alpha2 = std::min(0.125f * tan2(n), 1.0f);
    return 2 / (1 + std::sqrt(1 + alpha2 * tan2(light)));
  }

  float pdf_w(const Frame& tilted, const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const {
    const Vec3 o = tilted.to_local(wo), i = tilted.to_local(wi);
    return same_side(wo, o) && same_side(wi, i) ? inner_.pdf_w(at, o, i, asked) : 0;
  }

  std::optional<BsdfSample> sample_photon(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                          Lobes asked) const {
    const Vec3 n = normal(at);
    const Frame plain = frame_around(n), mirror = frame_around(mirrored(n));
    const bool other = u_lobe < kMirroredShare;
    const float share = other ? kMirroredShare : 1 - kMirroredShare;
    const float u_inner =
        std::min(kOneMinusEpsilon, (other ? u_lobe : u_lobe - kMirroredShare) / share);
    const Frame& tilted = other ? mirror : plain;
    const Vec3 o = tilted.to_local(wo);
    if (!same_side(wo, o)) return std::nullopt;
    std::optional<BsdfSample> s = inner_.sample(at, o, u_inner, u, asked, Carried::flux);
    if (!s) return s;
    const Vec3 i = s->wi;
    s->wi = tilted.to_world(i);
    if (!same_side(s->wi, i)) return std::nullopt;
    if (s->lobe == Lobes::delta) {
      if (!(towards(n, s->wi) == (other ? mirrored(n) : n))) return std::nullopt;
      s->pdf_w *= share;
      s->weight *= (o.z / wo.z) * (s->wi.z / i.z) * fade(tilted.n, wo) / share;
      return s;
    }
    s->pdf_w = (1 - kMirroredShare) * pdf_w(plain, at, wo, s->wi, asked) +
               kMirroredShare * pdf_w(mirror, at, wo, s->wi, asked);
    if (!(s->pdf_w > 0)) return std::nullopt;
    s->weight = f(at, wo, s->wi, asked, Carried::flux) * (std::abs(s->wi.z) / s->pdf_w);
    return is_black(s->weight) ? std::nullopt : s;
  }

  const Bsdf& inner_;
  TiltRepairs repairs_;
};

class BumpMap final : public Perturbed {
 public:
  BumpMap(const Bsdf& inner, Scalar height, float scale, TiltRepairs repairs)
      : Perturbed(inner, repairs), height_(height), scale_(scale) {}

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
  NormalMap(const Bsdf& inner, Color normals, TiltRepairs repairs)
      : Perturbed(inner, repairs), normals_(normals) {}

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

std::unique_ptr<Bsdf> make_bump_map(const Bsdf& inner, Scalar height, float scale,
                                    TiltRepairs repairs) {
  return std::make_unique<BumpMap>(inner, height, scale, repairs);
}

std::unique_ptr<Bsdf> make_normal_map(const Bsdf& inner, Color normals, TiltRepairs repairs) {
  return std::make_unique<NormalMap>(inner, normals, repairs);
}

}  // namespace octolux
