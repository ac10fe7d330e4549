// Which of a look-up's photons the query sees along its surface.
//
// In a dim place the nearest photons may be those of a bright one behind a wall, and a kernel that
// knows photons alone takes their light for its own. A ray along the tangent plane to each of them
// tells, as feelers do (feelers.h has the tolerances): what it meets is a wall unless it is the
// surface itself, curving. Photons that are left are on the query's side of every wall, and uniform
// there if irradiance is. Where something stands on the surface they lack its shadow as well, which
// makes the estimate too low by less as the bandwidth shrinks. Thread-safe.
#pragma once

#include <span>

#include "estimators/estimator.h"

namespace octolux {

/// Those of `found` (none farther than `radius` [m]) that the query sees, in their order; all if
/// there is nothing to see with. In memory of this thread that the next call overwrites.
std::span<const Neighbour> seen_photons(const GatherPoint& at, const PhotonMap& map,
                                        std::span<const Neighbour> found, float radius);

}  // namespace octolux
