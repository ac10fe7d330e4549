// Which way a lamp of a format without sides shines: into the scene. Closed pieces shine outwards
// already, or the file means otherwise; only open ones are turned.
#pragma once

#include <cstddef>

#include "core/shape.h"

namespace octolux {

/// Turns every connected open piece of `mesh` whose front faces away from `target` so that it faces
/// it; pieces hang together where triangles share a position. Returns the number of triangles
/// turned. A piece is open if its area vectors do not cancel.
std::size_t face_point(TriangleMesh& mesh, Vec3 target);

}  // namespace octolux
