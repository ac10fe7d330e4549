// photon_scatter.h.
#include "renderer/photon_scatter.h"

#include <algorithm>
#include <optional>

#include "core/sampling.h"

namespace octolux {

namespace {

constexpr float kAimed = 0.25f;   // share of photons outside
constexpr float kTarget = 1.5f;   // radius of what they are aimed at, in those of the focus
constexpr float kOutside = 1.5f;  // so many radii of the target away from its centre

/// The directions in which photons are aimed: those to a sphere that is seen from outside.
struct Cone {
  Vec3 axis;
  float sine2 = 0;  // of half its angle, squared

  float versine() const { return sine2 / (1 + std::sqrt(1 - sine2)); }
  float pdf_w() const { return 1 / (2 * kPi * versine()); }
  bool contains(Vec3 wi) const { return dot(axis, wi) > 0 && length2(cross(axis, wi)) < sine2; }
  Vec3 sample(Vec2 u) const {
    return normalize(Frame::from_normal(axis).to_world(sample_cone(u, versine())));
  }
};

std::optional<Cone> aim(const std::optional<Focus>& focus, Vec3 from) {
  if (!focus) return std::nullopt;
  const Vec3 way = focus->center - from;
  const float distance = length(way), target = kTarget * focus->radius;
  if (!(distance > kOutside * target)) return std::nullopt;
  return Cone{way * (1 / distance), target / distance * (target / distance)};
}

/// Sends an aimed photon on.
bool scatter_aimed(Flight& flight, const Scattering& at, Lobes lobes, const Cone& cone, Vec2 u) {
  const Vec3 wi = cone.sample(u);
  const float pdf_w = (1 - kAimed) * at.pdf_w(wi, lobes) + kAimed * cone.pdf_w();
  const Rgb flux = flight.flux * at.f_cos(wi, lobes) * (1 / pdf_w);
  if (is_black(flux) || !is_finite(flux)) return false;
  flight.flux = flux;
  flight.scattered = true;
  flight.flown = 0;
  flight.ray = at.spawn(wi);
  return true;
}

}  // namespace

bool scatter(Flight& flight, const Scattering& at, Lobes lobes, const std::optional<Focus>& focus,
             Rng& rng) {
  const bool smooth = any(lobes & Lobes::smooth) && at.bsdf().has(Lobes::smooth);
  const std::optional<Cone> cone = smooth ? aim(focus, at.point().position) : std::nullopt;
  const bool aimed = cone && rng.uniform() < kAimed;
  const float u_lobe = rng.uniform();
  const Vec2 u = rng.uniform2();
  const float u_survive = rng.uniform();
  if (aimed) return scatter_aimed(flight, at, lobes, *cone, u);

  const std::optional<BsdfSample> sample = at.sample(u_lobe, u, lobes);
  if (!sample) return false;
  const Rgb flux = flight.flux * sample->weight;
  float most = 1, balance = 1;  // of what the balance heuristic leaves to the BSDF
  if (cone) {
    const bool both = sample->lobe != Lobes::delta && cone->contains(sample->wi);
    const float by_cone = both ? kAimed * cone->pdf_w() : 0;
    most = 1 / (1 - kAimed);
    balance = sample->pdf_w / ((1 - kAimed) * sample->pdf_w + by_cone);
  }
  // Roulette must not make those heavy that the heuristic made light.
  const float survival = std::min(1.0f, most * max_component(flux) / max_component(flight.flux));
  if (!(u_survive < survival)) return false;
  flight.flux = flux * (balance / survival);
  if (any(sample->lobe & Lobes::smooth)) {
    flight.scattered = true;
    flight.flown = 0;
  }
  flight.ray = at.spawn(sample->wi);
  return true;
}

}  // namespace octolux
