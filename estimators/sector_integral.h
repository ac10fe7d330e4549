// Integrals over the sectors of a PhotonRegion, exactly. Pure functions.
#pragma once

#include <span>

#include "accel/photon_region.h"

namespace octolux {

/// At most so many half planes may cut a sector besides its own.
inline constexpr std::size_t kMaxExtraLines = 4;

/// Integral of 1 - taper d^2/h^2 over the part of sector `index` (0 to 7) within the disc of radius
/// h and the half planes of `also`.
double sector_integral(const PhotonRegion::Sector& sector, int index, float h, float taper,
                       std::span<const HalfPlane> also = {});

/// Distance of the farthest point of a sector, at most `limit` (where it may go on).
float sector_extent(const PhotonRegion::Sector& sector, int index, float limit);

}  // namespace octolux
