// Is the surface free around a query? What feelers would find if none of them met anything, without
// sending them. Most look-ups in a room are far enough from every wall.
#pragma once

#include "estimators/feelers.h"

namespace octolux {

/// No feeler meets anything up to `distance` [m] from the query, and with query.edges the surface
/// does not end there. May be false without need, where that is cheaper.
bool is_clear(const RayCaster& caster, const FeelerQuery& query, float distance);

}  // namespace octolux
