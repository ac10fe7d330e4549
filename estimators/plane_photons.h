// From a look-up's photons to points of the tangent plane, in units of the look-up's radius.
#pragma once

#include "core/frame.h"
#include "estimators/disc_search.h"
#include "estimators/octobox.h"

namespace octolux {

/// All photons of the look-up, and in the same go the flat estimate, radial_sum(FlatKernel).
Estimate sum_and_project(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                         PlanePoints& points);
/// All photons of the look-up.
void project_photons(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                     PlanePoints& points);
/// Those within the bandwidth alone.
void project_inner_photons(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                           PlanePoints& points);

}  // namespace octolux
