// The linear estimate over a region that geometry alone knows (free_region.h):
//
//   E = sum of flux_i K(d_i) [p_i in R] / integral of K over R and the disc of radius h,
//
// with K(d) = 1 - a d^2/h^2. R does not depend on the photons, so this is unbiased for constant
// irradiance at any number of photons, next to walls, corners and edges as on the open plane, and
// its bias elsewhere shrinks with h: there is no floor in a progressive render. The taper a is
// between the flat kernel (0), whose variance on the open plane is least, 1/n, and Epanechnikov's
// (1), whose bias in a given disc is least: with a = 0.8 the standard deviation is
// sqrt((1 - a + a^2/3) / (1 - a/2)^2) = 1.07 times that of the flat one. Immutable, thread-safe.
#include "estimators/region_search.h"

namespace octolux {

namespace {

constexpr float kTaper = 0.8f;
/// Below this share of the disc there is no region to speak of: a query inside a wall.
constexpr double kNothing = 1e-6;

class Region final : public Estimator {
 public:
  explicit Region(const RegionConfig& config) : config_(config) {}

  Estimate estimate(const GatherPoint& at, const PhotonMap& map,
                    const Bandwidth& bandwidth) const override {
    thread_local NeighbourBuffer buffer;
    RegionDisc found = find_in_region(at, map, bandwidth, config_, buffer);
    if (found.disc.empty()) return {};
    const float h = std::sqrt(found.disc.h2);
    const double whole = std::numbers::pi * (1 - 0.5 * kTaper) * found.disc.h2;
    double area = found.whole() ? whole : found.region.integral(h, kTaper);
    if (!(area > kNothing * whole)) {
      found.disc = find_disc(at, map, bandwidth, config_.neighbours, buffer);
      if (found.disc.empty()) return {};
      area = std::numbers::pi * (1 - 0.5 * kTaper) * found.disc.h2;
    }
    return sum(at, map, found.disc, area);
  }

 private:
  Estimate sum(const GatherPoint& at, const PhotonMap& map, const Disc& disc, double area) const {
    const float inv_h2 = 1 / disc.h2;
    const std::optional<Rgb> lambertian = at.at.lambertian();
    Rgb total(0);
    int count = 0;
    for (const Neighbour& near : disc.photons) {
      const float s = near.distance2 * inv_h2;
      if (!(s < 1)) continue;
      const Rgb flux = map.flux(near.photon) * (1 - kTaper * s);
      total += lambertian ? flux : flux * at.at.f(map.wi(near.photon), Lobes::smooth);
      ++count;
    }
    const Rgb scale = lambertian ? *lambertian * kInvPi : Rgb(1);
    const auto size = static_cast<float>(area);
    return {total * scale * (1 / size), std::sqrt(disc.h2), size, count};
  }

  RegionConfig config_;
};

}  // namespace

std::unique_ptr<Estimator> make_region(const EstimatorConfig& config) {
  return std::make_unique<Region>(RegionConfig{config.neighbours, config.feelers, true});
}

}  // namespace octolux
