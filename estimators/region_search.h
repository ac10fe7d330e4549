// The n photons nearest to a query among those in its free region (free_region.h).
//
// Feelers need a length before the look-up, and the look-up needs the region the feelers give. So a
// look-up without a region tells the scale r; feelers twice as long follow. Where they meet nothing
// within r, the photons found are those of the region, too, and the look-up is done: that is exact,
// and most queries end there. Elsewhere photons are looked up in the region, as far as it is known;
// if that holds too few of them, everything is done again at twice the scale. The last scale is
// max_radius or the size of the scene. So n photons stay n, and h is the distance of the next.
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
  bool whole = true;  // is the disc within the region?
};

/// The spans point into `buffer`.
RegionDisc find_in_region(const GatherPoint& at, const PhotonMap& map, const Bandwidth& bandwidth,
                          const RegionConfig& config, NeighbourBuffer& buffer);

}  // namespace octolux
