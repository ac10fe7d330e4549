// Cutting polygons into triangles. Own code because tinyobjloader's ear clipping compares with an
// absolute epsilon and drops faces that are small or far from the origin, and because a vertex in
// the middle of a straight edge must stay a corner of some triangle: the face next door has it too,
// and a ray must not slip between them (a light leak).
//
// Corners are judged in double in the coordinate plane that the polygon's normal (Newell's formula,
// Sutherland et al. 1974) is least inclined to, so no coordinate is rounded. Pure functions,
// thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace octolux {

/// Indices into `corners`, in the polygon's own winding; corners.size() - 2 triangles, of which
/// some have no area if the polygon is degenerate. A strictly convex polygon becomes the fan around
/// its first corner (as in Mitsuba); any other simple polygon is cut by ear clipping (Meisters
/// 1975). A polygon that crosses itself is cut somehow. Needs at least three corners.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3> corners);

}  // namespace octolux
