// How many eye samples a pass takes of direct light and caustics alone, beside those that gather.
// They cost a tenth as much, and where noise is that of lamps' shadows, of edges and of what glass
// and metal show, they take it away; where it is indirect light's they would be in vain. The
// picture stays the same: each path class is the mean of its own samples.
#pragma once

#include "renderer/config.h"
#include "renderer/film.h"

namespace octolux {

/// How many for every eye sample that gathers the first two passes take: as set, or a few, which
/// tell how many are wanted. None where nothing is gathered.
std::int64_t first_direct_samples(const RenderConfig& config);

/// How many minimize noise times time: sqrt(V C / (v c)) - 1 at variances V of direct light, v of
/// indirect light and costs c, C of their samples (Neyman's allocation; at least 0, at most 15).
/// The variances are those of two passes, which took `taken` of them for each, relative to the
/// square of each pixel: `first`, a film of one pass, and `second`.
std::int64_t wanted_direct_samples(const Film& first, const PassImage& second, std::int64_t taken);

}  // namespace octolux
