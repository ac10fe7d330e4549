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
#include "estimators/radial.h"
#include "estimators/region_search.h"

namespace octolux {

namespace {

constexpr float kTaper = 0.8f;
constexpr float kVolume = 1 - 0.5f * kTaper;  // mean of K over the disc
/// Below this share of the disc there is no region to speak of: a query inside a wall.
constexpr double kNothing = 1e-6;

/// K, normalised over the whole disc.
struct Tapered {
  float k(float s) const { return (1 - kTaper * s) * (kInvPi / kVolume); }
};

class Region final : public Estimator {
 public:
  explicit Region(const RegionConfig& config) : config_(config) {}

  Estimate estimate(const GatherPoint& at, const PhotonMap& map,
                    const Bandwidth& bandwidth) const override {
    thread_local NeighbourBuffer buffer;
    const RegionDisc found = find_in_region(at, map, bandwidth, config_, buffer);
    if (found.disc.empty()) return {};
    const double share = found.whole() ? 1 : share_of_disc(found);
    if (!(share > kNothing)) {
      const Disc disc = find_disc(at, map, bandwidth, {config_.neighbours}, buffer);
      return disc.empty() ? Estimate{} : radial_sum(at, map, disc, Tapered{});
    }
    Estimate estimate = radial_sum(at, map, found.disc, Tapered{});
    estimate.radiance = in_range(estimate.radiance * static_cast<float>(1 / share));
    estimate.area *= static_cast<float>(share);
    return estimate;
  }

  float k(float s) const override { return Tapered{}.k(s); }
  bool sees_geometry() const override { return true; }

 private:
  /// Integral of K over R by that over the whole disc.
  static double share_of_disc(const RegionDisc& found) {
    const float h = std::sqrt(found.disc.h2);
    const double whole = std::numbers::pi * kVolume * h * h;
    return found.region.integral(h, kTaper) / whole;
  }

  RegionConfig config_;
};

}  // namespace

std::unique_ptr<Estimator> make_region(const EstimatorConfig& config) {
  return std::make_unique<Region>(RegionConfig{config.neighbours, config.feelers, true});
}

}  // namespace octolux
