// Where the gather rays of one point go. Where light comes from few directions (learned_guides.h),
// half follow the guide to it, combined with the BSDF by the balance heuristic (Veach 1997, 9.2.2).
// Elsewhere a guide would only bring noise of its own, and all follow the BSDF.
#pragma once

#include <optional>

#include "core/point_set.h"
#include "core/rng.h"
#include "core/scattering.h"
#include "renderer/lobe_mixture.h"

namespace octolux {

/// Where a gather ray goes.
struct GatherDirection {
  Vec3 wi;
  Rgb weight;            // f |cos wi| over the density of all rays together [sr]
  float bsdf_pdf_w = 0;  // [sr^-1] as if the BSDF had chosen it
};

class GatherDirections {
 public:
  /// One for each ray of either kind.
  struct Points {
    PointSet by_bsdf, by_guide;
  };
  /// How many of `rays` follow the guide.
  static int guided(const LobeMixture& guide, int rays) { return guide.empty() ? 0 : rays / 2; }

  /// Refers to `at` and `guide`, which may be empty.
  GatherDirections(const Scattering& at, const LobeMixture& guide, int rays, const Points& points);
  /// Direction `i` of `rays`; empty if it brings nothing. The sum of weight times radiance over
  /// all `i` is the reflected radiance in the mean.
  std::optional<GatherDirection> draw(int i, Rng& rng) const;

 private:
  std::optional<GatherDirection> by_bsdf(float u_lobe, Vec2 u) const;
  std::optional<GatherDirection> by_guide(Vec2 u) const;

  const Scattering& at_;
  const LobeMixture& guide_;
  int guided_, unguided_;  // how many rays follow which
  const Points points_;
};

}  // namespace octolux
