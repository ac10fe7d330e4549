// Estimators whose kernel depends on distance alone: L = 1/h^2 * sum k(d^2/h^2) f(wo, wi) flux.
// The kernel is a type with `float k(float s) const`, s = d^2/h^2 in [0, 1), pi * integral_0^1 k ds
// = 1; it is inlined into one loop.
#pragma once

#include <memory>

#include "estimators/estimator.h"

namespace octolux {

template <class Kernel>
class Radial final : public Estimator {
 public:
  Radial(int neighbours, Kernel kernel) : neighbours_(neighbours), kernel_(kernel) {}

  Rgb radiance(const GatherPoint& at, const PhotonMap& map,
               const Bandwidth& bandwidth) const override {
    thread_local NeighbourBuffer buffer;
    const std::size_t wanted = static_cast<std::size_t>(neighbours_) + 1;
    std::span<const Neighbour> found = map.nearest(photon_query(at, bandwidth), wanted, buffer);
    float h2 = bandwidth.max_radius * bandwidth.max_radius;
    if (found.size() == wanted || !std::isfinite(h2)) {
      if (found.empty()) return Rgb(0);
      h2 = found.back().distance2;
      found = found.first(found.size() - 1);
    }
    h2 *= bandwidth.shrink * bandwidth.shrink;
    if (!(h2 >= std::numeric_limits<float>::min())) return Rgb(0);
    return sum(at, map, found, h2);
  }

 private:
  /// One sum of flux where f is constant, one call of f per photon elsewhere.
  Rgb sum(const GatherPoint& at, const PhotonMap& map, std::span<const Neighbour> found,
          float h2) const {
    const float inv_h2 = 1 / h2;
    const std::optional<Rgb> lambertian = at.at.lambertian();
    Rgb total(0);
    for (const Neighbour& near : found) {
      const float s = near.distance2 * inv_h2;
      if (!(s < 1)) continue;
      const Rgb flux = map.flux(near.photon) * kernel_.k(s);
      total += lambertian ? flux : flux * at.at.f(map.wi(near.photon), Lobes::smooth);
    }
    return total * (lambertian ? *lambertian * kInvPi : Rgb(1)) * inv_h2;
  }

  int neighbours_;
  Kernel kernel_;
};

}  // namespace octolux
