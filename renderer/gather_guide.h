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
#include "renderer/learned_guides.h"

namespace octolux {

/// A density over directions, fixed once made. No allocation.
class GatherGuide {
 public:
  GatherGuide() = default;
  /// From photons that a smooth lobe scattered: next-event estimation and the caustic map bring the
  /// others, also those that came through panes or glass. Of many photons, an evenly spread share
  /// is used. `normal`: unit, of the surface, on the side the photons came from.
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

/// What is known of the light around a point: by the photons of this pass, and by what was learned
/// before (may be null). One that says that light comes evenly is not followed; of two, the one
/// more often that says what photons it does not know will do: both have measured that as their
/// unevenness.
class GuidePair {
 public:
  GuidePair(const GatherGuide& nearby, const LearnedGuide* learned);

  bool empty() const { return share_ == 0 && !learned_; }
  /// Density [sr^-1] of `sample`. Neither if empty.
  float pdf_w(Vec3 wi) const;
  Vec3 sample(Vec2 u) const;

 private:
  const GatherGuide& nearby_;
  const LearnedGuide* learned_ = nullptr;
  float share_ = 0;  // of samples that follow `nearby_`
};

/// The rays of one point. Where light comes from few directions, half follow the guides, combined
/// with the BSDF by the balance heuristic (Veach 1997, 9.2.2). Elsewhere guides would only bring
/// noise of their own, and all follow the BSDF.
class GatherDirections {
 public:
  /// One for each ray of either kind.
  struct Points {
    PointSet by_bsdf, by_guide;
  };
  /// How many of `rays` follow the guides.
  static int guided(const GuidePair& guides, int rays) { return guides.empty() ? 0 : rays / 2; }

  /// Refers to `at`, and to what `guides` refers to.
  GatherDirections(const Scattering& at, const GuidePair& guides, int rays, const Points& points);
  /// Direction `i` of `rays`; empty if it brings nothing. The sum of weight times radiance over
  /// all `i` is the reflected radiance in the mean.
  std::optional<GatherDirection> draw(int i, Rng& rng) const;

 private:
  std::optional<GatherDirection> by_bsdf(float u_lobe, Vec2 u) const;
  std::optional<GatherDirection> by_guide(Vec2 u) const;

  const Scattering& at_;
  const GuidePair guides_;
  int guided_, unguided_;  // how many rays follow which
  const Points points_;
};

}  // namespace octolux
