// The neighbourhood every kernel starts from: the photons of a disc on the tangent plane, and its
// radius, the bandwidth (estimator.h has the rule and why it is unbiased).
#pragma once

#include "estimators/estimator.h"

namespace octolux {

/// Photons within the bandwidth. With shrink < 1 some of `photons` are farther than h: those with
/// distance2 >= h2 do not count.
struct Disc {
  std::span<const Neighbour> photons;
  float h2 = 0;  // [m^2] square of the bandwidth
  bool empty() const { return photons.empty() || h2 == 0; }
};

/// The disc of `neighbours` photons around the point. The span points into `buffer`.
inline Disc find_disc(const GatherPoint& at, const PhotonMap& map, const Bandwidth& bandwidth,
                      int neighbours, NeighbourBuffer& buffer) {
  const std::size_t wanted = static_cast<std::size_t>(neighbours) + 1;
  std::span<const Neighbour> found = map.nearest(photon_query(at, bandwidth), wanted, buffer);
  float h2 = bandwidth.max_radius * bandwidth.max_radius;
  if (found.size() == wanted || !std::isfinite(h2)) {
    if (found.empty()) return {};
    h2 = found.back().distance2;
    found = found.first(found.size() - 1);
  }
  h2 *= bandwidth.shrink * bandwidth.shrink;
  // A bandwidth whose square is no normal number has no density: every photon is at the query.
  return {found, h2 >= std::numeric_limits<float>::min() ? h2 : 0};
}

}  // namespace octolux
