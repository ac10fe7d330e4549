// Photons from infinitely far away: for each direction they start on a disk as wide as the scene's
// bounding sphere and just behind it, at right angles to the direction (Dutre et al. 2006, 4.2.1).
// Used by the infinite lights alone.
//
// A room may be small beside the ground around it. Where a focus is known, half of the photons are
// spread over the disk evenly; of the others as many pass the focus at 1 to 10 m as at 10 to 100 m.
#pragma once

#include "core/frame.h"
#include "core/ray.h"
#include "core/sampling.h"

namespace octolux {

struct SceneSphere {
  Vec3 center;
  float radius = 0;  // [m]
  Vec3 focus;        // inside, if `near` is above 0
  float near = 0;    // [m] from the focus, and nearer, photons lie evenly; 0: there is no focus

  /// Area [m^2] of its shadow: 1 / the density of starting points without a focus.
  float cross_section() const { return kPi * radius * radius; }

  struct Start {
    Ray ray;
    float pdf_a = 0;  // [m^-2] density of such rays
  };
  /// The ray of a photon that arrives from `wi`.
  Start incoming(Vec3 wi, Vec2 u) const;
};

}  // namespace octolux
