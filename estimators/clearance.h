// How far is the surface free around a query? What feelers would find, without sending them. Most
// look-ups in a room are nearer to their photons than to any wall.
#pragma once

#include "estimators/feelers.h"

namespace octolux {

/// No feeler meets anything nearer to the query than this [m], and with query.edges the surface
/// does not end there. At most `distance`. May be less than could be said, and is 0 where it would
/// be less than `least`: where finding out costs more than feelers do.
float free_distance(const RayCaster& caster, const FeelerQuery& query, float distance, float least);

}  // namespace octolux
