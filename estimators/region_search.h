// The n photons nearest to a query among those in its free region (free_region.h).
//
// Feelers need a length before the look-up, and the look-up needs the region the feelers give. So
// the leaf of the photon map at the query says how dense photons are there, feelers go a few times
// as far as n photons should reach, and photons are looked up in the region as far as it is known.
// If that holds too few of them, both are done again at twice the length, until the region ends on
// all sides (a chair's leg), or up to max_radius or the size of the scene. So n photons stay n, and
// h is the distance of the next. The guess decides how
// much work there is and how much of the free surface is recognised as such, never what is counted
// on it: that is, for constant irradiance it cannot bias anything.
#pragma once

#include "estimators/disc_search.h"
#include "estimators/free_region.h"

namespace octolux {

struct RegionConfig {
  int neighbours = 50;
  int feelers = 8;
  bool edges = true;
};

/// Photons of a free region within the bandwidth (see Disc).
struct RegionDisc {
  Disc disc;
  FreeRegion region;
  bool whole() const { return region.clearance() * region.clearance() >= disc.h2; }
};

/// Feelers around the point; their length and whether they look for edges are the caller's choice.
FeelerQuery feeler_query(const GatherPoint& at, int feelers);

/// The spans point into `buffer`.
RegionDisc find_in_region(const GatherPoint& at, const PhotonMap& map, const Bandwidth& bandwidth,
                          const RegionConfig& config, NeighbourBuffer& buffer);

}  // namespace octolux
