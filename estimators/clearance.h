// How far around a query the surface is free for certain: what feelers would find if none of them
// met anything, without sending them. Most look-ups in a room are far enough from every wall.
#pragma once

#include "estimators/feelers.h"

namespace octolux {

/// No feeler up to this distance [m] from the query meets anything, at most `limit`; with
/// query.edges nor does the surface end there. Too low where that is cheaper, never too high.
float clearance(const RayCaster& caster, const FeelerQuery& query, float limit);

}  // namespace octolux
