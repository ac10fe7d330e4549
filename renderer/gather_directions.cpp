// gather_directions.h.
#include "renderer/gather_directions.h"

namespace octolux {

GatherDirections::GatherDirections(const Scattering& at, const LobeMixture& guide, int rays,
                                   const Points& points)
    : at_(at),
      guide_(guide),
      guided_(guided(guide, rays)),
      unguided_(rays - guided_),
      points_(points) {}

std::optional<GatherDirection> GatherDirections::draw(int i, Rng& rng) const {
  if (i >= unguided_) return by_guide(points_.by_guide[i - unguided_]);
  const float u_lobe = rng.uniform();
  return by_bsdf(u_lobe, points_.by_bsdf[i]);
}

std::optional<GatherDirection> GatherDirections::by_bsdf(float u_lobe, Vec2 u) const {
  const std::optional<BsdfSample> s = at_.sample(u_lobe, u, Lobes::smooth);
  if (!s || is_black(s->weight)) return std::nullopt;
  float rays = static_cast<float>(unguided_);
  if (guided_ > 0) rays += static_cast<float>(guided_) * guide_.pdf_w(s->wi) / s->pdf_w;
  return GatherDirection{s->wi, s->weight / rays, s->pdf_w};
}

std::optional<GatherDirection> GatherDirections::by_guide(Vec2 u) const {
  const Vec3 wi = guide_.sample(u);
  const Rgb f_cos = at_.f_cos(wi, Lobes::smooth);
  if (is_black(f_cos)) return std::nullopt;
  const float pdf_w = at_.pdf_w(wi, Lobes::smooth);
  const float density =
      static_cast<float>(unguided_) * pdf_w + static_cast<float>(guided_) * guide_.pdf_w(wi);
  if (!(density > 0)) return std::nullopt;  // rounded over the edge of what is known
  return GatherDirection{wi, f_cos / density, pdf_w};
}

}  // namespace octolux
