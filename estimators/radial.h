// Estimators whose kernel depends on distance alone: L = 1/h^2 * sum k(d^2/h^2) f(wo, wi) flux.
// The kernel is a type with `float k(float s) const`, s = d^2/h^2 in [0, 1), pi * integral_0^1 k ds
// = 1; it is inlined into one loop.
#pragma once

#include <memory>
#include <type_traits>

#include "estimators/disc_search.h"
#include "estimators/flux_sum.h"
#include "estimators/photon_group.h"

namespace octolux {

/// k = 1/pi: every photon within h counts the same.
struct FlatKernel {
  float k(float /*s*/) const { return kInvPi; }
};

/// Values beyond a float's range are its largest, not infinite: powers of photons may span twelve
/// decades, and areas be tiny.
inline Rgb in_range(Rgb c) {
  constexpr float kMost = std::numeric_limits<float>::max();
  return {std::min(c.r, kMost), std::min(c.g, kMost), std::min(c.b, kMost)};
}

/// Sum of flux over the disc's area, where f is constant.
inline Estimate flat_estimate(Rgb flux, int count, const Disc& disc, Rgb reflectance) {
  const Rgb scale = reflectance * (kInvPi * kInvPi);
  return {in_range(flux * scale * (1 / disc.h2)), std::sqrt(disc.h2), kPi * disc.h2, count,
          disc.photons};
}

/// The same for every kernel that does not weigh photons, where f is constant.
inline Estimate flat_sum(const PhotonMap& map, const Disc& disc, Rgb reflectance) {
  FluxSum sum;
  Mask8 count{};
  for (std::size_t i = 0; i < disc.photons.size(); i += 8) {
    const PhotonGroup group = photon_group(disc.photons, i);
    const Mask8 inside = group.distance2 < disc.h2;
    sum.add(group.fluxes(map, 0, inside));
    sum.add(group.fluxes(map, 1, inside));
    count -= inside;
  }
  return flat_estimate(sum.total(), sum8(count), disc, reflectance);
}

/// The sum over a disc's photons: one sum of flux where f is constant, one call of f per photon
/// elsewhere.
template <class Kernel>
Estimate radial_sum(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                    const Kernel& kernel) {
  const float inv_h2 = 1 / disc.h2;
  const std::optional<Rgb> lambertian = at.at.lambertian();
  if constexpr (std::is_same_v<Kernel, FlatKernel>) {
    if (lambertian) return flat_sum(map, disc, *lambertian);
  }
  Rgb total(0);
  int count = 0;
  for (const Neighbour& near : disc.photons) {
    if (!(near.distance2 < disc.h2)) continue;
    const Rgb flux = map.flux(near.photon) * kernel.k(near.distance2 * inv_h2);
    total += lambertian ? flux : flux * at.at.f_flux(map.wi(near.photon), Lobes::smooth);
    ++count;
  }
  const Rgb scale = lambertian ? *lambertian * kInvPi : Rgb(1);
  return {in_range(total * scale * inv_h2), std::sqrt(disc.h2), kPi * disc.h2, count, disc.photons};
}

template <class Kernel>
class Radial final : public Estimator {
 public:
  Radial(const EstimatorConfig& config, Kernel kernel)
      : rule_(disc_rule(config)), kernel_(kernel) {}

  Estimate estimate(const GatherPoint& at, const PhotonMap& map,
                    const Bandwidth& bandwidth) const override {
    thread_local NeighbourBuffer buffer;
    const Disc disc = find_disc(at, map, bandwidth, rule_, buffer);
    return disc.empty() ? Estimate{} : radial_sum(at, map, disc, kernel_);
  }
  float k(float s) const override { return kernel_.k(s); }
  bool sees_geometry() const override { return rule_.seen; }

 private:
  DiscRule rule_;
  Kernel kernel_;
};

}  // namespace octolux
