// Where light comes from: places that photons of a neighbourhood flew from, in clusters. As these
// are places, not directions, a point beside the neighbourhood's middle sees each where it is
// (Ruppert, Herholz & Lensch, "Robust Fitting of Parallax-Aware Mixtures for Path Guiding",
// SIGGRAPH 2020): neighbourhoods can be large, with many photons each, and yet tell a small opening
// across the room from the wall around it.
#pragma once

#include <span>
#include <vector>

#include "core/vec.h"
#include "renderer/lobe_mixture.h"

namespace octolux {

/// Fixed once made.
class LightOrigins {
 public:
  struct Photon {
    Vec3 origin;     // [m] where it flew from
    float flux = 0;  // [W] > 0
  };

  LightOrigins() = default;
  /// Clusters of the photons as `center` sees them, at most LobeMixture::kMost. A photon that flew
  /// from `center` itself does not count.
  LightOrigins(std::span<const Photon> photons, Vec3 center);

  /// The directions of light at `point`: a lobe for each cluster. Empty if made from nothing.
  LobeMixture seen_from(Vec3 point) const;

 private:
  struct Cluster {
    Vec3 position;     // [m]
    float spread = 0;  // [m^2]: mean 1 - cos of its photons' angles to it, times distance squared
    float share = 0;   // of all flux; all sum to 1
  };
  std::vector<Cluster> clusters_;
};

}  // namespace octolux
