// A BSDF at a point of a surface, seen from `wo`: world-space directions, and the care that
// interpolated shading normals need.
//
// A direction must lie on the same side of the shading and of the geometric normal, otherwise light
// would leak through the surface. Photons are scattered by the adjoint BSDF: its ratio of cosines
// (Veach 1997, 5.3.2) keeps photon and eye paths in agreement.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/bsdf.h"
#include "core/frame.h"
#include "core/ray.h"

namespace octolux {

class Scattering {
 public:
  /// `wo`: unit, world space, away from the surface.
  Scattering(const SurfacePoint& point, const Bsdf& bsdf, Vec3 wo, Carried carried)
      : point_(point),
        bsdf_(bsdf),
        frame_(Frame::from_tangent(point.ns, point.dp_du)),
        wo_(wo),
        wo_local_(frame_.to_local(wo)),
        wo_ng_(dot(wo, point.ng)),
        carried_(carried) {}

  const SurfacePoint& point() const { return point_; }
  const Bsdf& bsdf() const { return bsdf_; }
  Vec3 wo() const { return wo_; }
  /// Geometric normal on wo's side.
  Vec3 facing_normal() const { return wo_ng_ < 0 ? -point_.ng : point_.ng; }

  /// Does `wi` lie on the other side of the surface than wo?
  bool transmits(Vec3 wi) const { return dot(wi, facing_normal()) < 0; }
  /// Shading normal on the same side of the surface.
  Vec3 facing_shading_normal() const { return wo_ng_ < 0 ? -point_.ns : point_.ns; }

  /// f(wo, wi) [sr^-1] without cosine; wi in world space.
  Rgb f(Vec3 wi, Lobes lobes) const {
    const Vec3 local = frame_.to_local(wi);
    if (!consistent(wi, local)) return Rgb(0);
    return bsdf_.f(point_, wo_local_, local, lobes, carried_) * adjoint(wi, local);
  }

  /// f |cos wi|, as next-event estimation wants it.
  Rgb f_cos(Vec3 wi, Lobes lobes) const { return f(wi, lobes) * std::abs(dot(wi, point_.ns)); }

  /// Radiance per arriving flux density, for density estimation: photons lie as densely as the
  /// geometric cosine has them, while an eye path weighs them by the shading one. The ratio of the
  /// two has no bound, nor have estimates of it a variance (of photons along the surface, whose
  /// geometric cosine c is as frequent as it is large, the mean of 1 / c^2 is infinite), so it is
  /// cut. Under even light that loses t^2 / (4 (kMostRatio - 1)) of all, the normals being t apart:
  /// 0.3 % at 17 degrees.
  Rgb f_flux(Vec3 wi, Lobes lobes) const {
    const Rgb value = f(wi, lobes);
    if (point_.ns == point_.ng) return value;
    return value * std::min(kMostRatio, std::abs(dot(wi, point_.ns) / dot(wi, point_.ng)));
  }

  float pdf_w(Vec3 wi, Lobes lobes) const {
    return bsdf_.pdf_w(point_, wo_local_, frame_.to_local(wi), lobes);
  }

  /// As Bsdf::sample, with wi in world space.
  std::optional<BsdfSample> sample(float u_lobe, Vec2 u, Lobes lobes) const {
    std::optional<BsdfSample> s = bsdf_.sample(point_, wo_local_, u_lobe, u, lobes, carried_);
    if (!s) return s;
    const Vec3 local = s->wi;
    s->wi = frame_.to_world(local);
    if (!consistent(s->wi, local)) return std::nullopt;
    s->weight *= adjoint(s->wi, local);
    return s;
  }

  Rgb pass_through() const { return bsdf_.pass_through(point_, wo_local_); }
  /// Empty also where the normals differ: then directions matter (f_flux).
  std::optional<Rgb> lambertian() const {
    return point_.ns == point_.ng ? diffuse_reflectance() : std::nullopt;
  }
  /// Bsdf::lambertian: what leaves is this, over pi, times the irradiance of the shading normal.
  std::optional<Rgb> diffuse_reflectance() const {
    return wo_ng_ * wo_local_.z > 0 ? bsdf_.lambertian(point_, wo_local_) : std::nullopt;
  }

  /// Reflectance of the diffuse lobe under a coat, for light from straight above; empty if there is
  /// none.
  std::optional<Rgb> coated_reflectance() const {
    if (!(wo_ng_ * wo_local_.z > 0)) return std::nullopt;
    const std::optional<Rgb> f = bsdf_.coated_base(point_, wo_local_, {0, 0, wo_local_.z});
    return f ? std::optional(*f * kPi) : std::nullopt;
  }
  /// The share of that lobe in what smooth lobes scatter from wi.
  Rgb coated_share(Vec3 wi) const {
    const Vec3 local = frame_.to_local(wi);
    const std::optional<Rgb> base = bsdf_.coated_base(point_, wo_local_, local);
    const Rgb all = bsdf_.f(point_, wo_local_, local, Lobes::smooth, carried_);
    const auto share = [&](int c) {
      return base && all[c] > 0 ? std::min(1.0f, (*base)[c] / all[c]) : 0.0f;
    };
    return {share(0), share(1), share(2)};
  }

  /// A ray leaving this point towards `direction`.
  Ray spawn(Vec3 direction) const {
    return {offset_origin(point_.position, point_.ng, point_.error, direction), direction};
  }

 private:
  static constexpr float kMostRatio = 8;

  bool consistent(Vec3 wi, Vec3 wi_local) const {
    return dot(wi, point_.ng) * wi_local.z > 0 && wo_ng_ * wo_local_.z > 0;
  }
  float adjoint(Vec3 wi, Vec3 wi_local) const {
    if (carried_ == Carried::radiance || point_.ns == point_.ng) return 1;
    return std::abs((wo_local_.z * dot(wi, point_.ng)) / (wo_ng_ * wi_local.z));
  }

  const SurfacePoint& point_;
  const Bsdf& bsdf_;
  Frame frame_;
  Vec3 wo_;
  Vec3 wo_local_;
  float wo_ng_;
  Carried carried_;
};

}  // namespace octolux
