// How far the photons of a leaf are from a query: all of them at once, in SIMD. Inline, because it
// is the innermost part of every look-up.
#pragma once

#include <bit>
#include <cstdint>

#include "accel/photon_map.h"

namespace octolux {

/// Squared distances of a block's photons, in the squashed metric.
struct BlockDistances {
  alignas(64) float distance2[PhotonTree::kBlockSize];

  BlockDistances(const PhotonTree::Block& block, const PhotonQuery& query) {
    const float squash = query.squash * query.squash - 1;
    const Vec3 p = query.position;
    const Vec3 n = query.normal;
    for (std::uint32_t i = 0; i < PhotonTree::kBlockSize; ++i) {
      const float dx = block.x[i] - p.x;
      const float dy = block.y[i] - p.y;
      const float dz = block.z[i] - p.z;
      const float along = dx * n.x + dy * n.y + dz * n.z;
      distance2[i] = dx * dx + dy * dy + dz * dz + squash * (along * along);
    }
  }
  /// A bit for each lane.
  std::uint32_t nearer_than(float limit) const {
    std::uint32_t lanes = 0;
    // Unrolled, it is no loop any more when GCC looks for loops to make SIMD of.
#pragma GCC unroll 1
    for (std::uint32_t i = 0; i < PhotonTree::kBlockSize; ++i) {
      lanes |= static_cast<std::uint32_t>(distance2[i] < limit) << i;
    }
    return lanes;
  }
  /// The lane of those given, at least one, that is nearest; of equals the first.
  std::uint32_t nearest_of(std::uint32_t lanes) const {
    auto nearest = static_cast<std::uint32_t>(std::countr_zero(lanes));
    for (lanes &= lanes - 1; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      if (distance2[lane] < distance2[nearest]) nearest = lane;
    }
    return nearest;
  }
};

}  // namespace octolux
