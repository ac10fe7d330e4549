// Where gather rays should look: the directions from which photons came to the point, each widened
// to a lobe (Jensen, "Importance driven path tracing using the photon map", 1995). The photons are
// those the final gather has already looked up for its bandwidth, so a guide costs no search.
//
// Lobes are spherical Cauchy distributions (Kato & McCullagh, arXiv:1510.07679, 2020): density,
// normalisation and sampling are rational functions, no exp or log; and their tails are heavy, so
// a photon's lobe never claims that its neighbourhood is dark. A lobe is as wide as the photons'
// directions are sparse around it: a small bright place far off is met as well as a ceiling.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "accel/photon_map.h"
#include "core/point_set.h"
#include "core/rng.h"
#include "core/scattering.h"

namespace octolux {

/// A density over directions, fixed once made. No allocation.
class GatherGuide {
 public:
  GatherGuide() = default;
  /// From photons that were scattered at least once: what came straight from a light is brought by
  /// next-event estimation. Of many photons, an evenly spread share is used. `normal`: unit, of the
  /// surface, on the side the photons came from.
  GatherGuide(const PhotonMap& map, std::span<const Neighbour> photons, Vec3 normal);

  /// The second moment of radiance times cosine, were directions chosen by the cosine, over that of
  /// the best choice: 1 where light comes evenly from everywhere. What each photon says is held
  /// against the lobes of the others: infinite if there is but one, 1 if there is none, and then
  /// there is nothing to sample.
  float unevenness() const { return unevenness_; }
  /// Density [sr^-1] of `sample`.
  float pdf_w(Vec3 wi) const;
  /// A direction, not always above the surface. `u` uniform in [0, 1)^2.
  Vec3 sample(Vec2 u) const;

 private:
  static constexpr std::size_t kMaxLobes = 64;
  void fit_widths();
  float find_unevenness(Vec3 normal) const;

  std::size_t count_ = 0;
  float unevenness_ = 1;
  std::array<float, kMaxLobes> x_, y_, z_;         // axes
  std::array<float, kMaxLobes> share_;             // of all flux; sums to 1
  std::array<float, kMaxLobes> sharpness_, peak_;  // k and share (1 + 2k) / (4 pi)
};

/// Where a gather ray goes.
struct GatherDirection {
  Vec3 wi;
  Rgb weight;            // f |cos wi| over the density of all rays together [sr]
  float bsdf_pdf_w = 0;  // [sr^-1] as if the BSDF had chosen it
};

/// The rays of one point. Where light comes from few directions, half follow the guide, combined
/// with the BSDF by the balance heuristic (Veach 1997, 9.2.2). Elsewhere a guide made from a few
/// photons would bring noise of its own, other in every pass, and all follow the BSDF.
class GatherDirections {
 public:
  /// Refers to `at`, `guide` and `points`, one for each ray.
  GatherDirections(const Scattering& at, const GatherGuide& guide, int rays,
                   const PointSet& points);
  /// Direction `i` of `rays`; empty if it brings nothing. The sum of weight times radiance over
  /// all `i` is the reflected radiance in the mean.
  std::optional<GatherDirection> draw(int i, Rng& rng) const;

 private:
  std::optional<GatherDirection> by_bsdf(float u_lobe, Vec2 u) const;
  std::optional<GatherDirection> by_guide(Vec2 u) const;

  const Scattering& at_;
  const GatherGuide& guide_;
  int guided_, unguided_;  // how many rays follow which
  const PointSet& points_;
};

}  // namespace octolux
