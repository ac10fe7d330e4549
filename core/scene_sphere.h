// Photons from infinitely far away: for each direction they start on a disk as wide as the scene's
// bounding sphere and just behind it, at right angles to the direction (Dutre et al. 2006, 4.2.1).
// Used by the infinite lights alone.
#pragma once

#include "core/frame.h"
#include "core/ray.h"
#include "core/sampling.h"

namespace octolux {

struct SceneSphere {
  Vec3 center;
  float radius = 0;  // [m]

  /// Area [m^2] of its shadow: 1 / the density of starting points.
  float cross_section() const { return kPi * radius * radius; }

  /// The ray of a photon that arrives from `wi`.
  Ray incoming(Vec3 wi, Vec2 u) const {
    const Vec2 d = sample_disk(u);
    const Frame frame = Frame::from_normal(wi);
    const float error = position_error_bound(abs(center) + Vec3{radius, radius, radius});
    return {center + (frame.s * d.x + frame.t * d.y) * radius + wi * (radius + error), -wi};
  }
};

}  // namespace octolux
