// The neighbourhood every kernel starts from: the photons of a disc on the tangent plane, and its
// radius, the bandwidth (estimator.h has the rule and why it is unbiased).
#pragma once

#include "estimators/estimator.h"
#include "estimators/seen_photons.h"

namespace octolux {

/// Photons within the bandwidth. With shrink < 1 some of `photons` are farther than h: those with
/// distance2 >= h2 do not count.
struct Disc {
  std::span<const Neighbour> photons;
  float h2 = 0;      // [m^2] square of the bandwidth
  float r2 = 0;      // [m^2] the same without shrinking: all photons are nearer
  bool cut = false;  // a wall cuts it: photons behind it are left out
  bool empty() const { return photons.empty() || h2 == 0; }
};

/// Which photons make a disc.
struct DiscRule {
  int neighbours = 20;  // n
  bool next = true;     // the (n+1)th bounds the disc; or, as published, the nth, which counts, too
  bool seen = false;    // of these, those that the point sees (seen_photons.h)
};
inline DiscRule disc_rule(const EstimatorConfig& config) {
  return {config.neighbours, config.correction, config.correction && config.seen};
}

/// A bandwidth whose square is no normal number has no density: every photon is at the query.
inline float usable_bandwidth2(float h2) {
  return h2 >= std::numeric_limits<float>::min() && std::isfinite(h2) ? h2 : 0;
}

/// The disc of n photons around the point. The span points into `buffer`, or to memory of this
/// thread that the next call overwrites.
inline Disc find_disc(const GatherPoint& at, const PhotonMap& map, const Bandwidth& bandwidth,
                      const DiscRule& rule, NeighbourBuffer& buffer) {
  const std::size_t wanted = static_cast<std::size_t>(rule.neighbours) + (rule.next ? 1 : 0);
  std::span<const Neighbour> found = map.nearest(photon_query(at, bandwidth), wanted, buffer);
  float r2 = bandwidth.max_radius * bandwidth.max_radius;
  if (found.size() == wanted || !std::isfinite(r2)) {
    if (found.empty()) return {};
    r2 = found.back().distance2;
    if (rule.next) found = found.first(found.size() - 1);
    if (!rule.next && r2 > 0) r2 = std::nextafter(r2, kInfinity);  // so that the last one is nearer
  }
  const std::size_t all = found.size();
  if (rule.seen) found = seen_photons(at, map, found, std::sqrt(r2));
  const float h2 = usable_bandwidth2(r2 * (bandwidth.shrink * bandwidth.shrink));
  return {found, h2, r2, found.size() < all};
}

}  // namespace octolux
