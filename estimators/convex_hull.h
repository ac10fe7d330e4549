// The convex hull of points in the plane (Andrew's monotone chain, 1979), in double precision.
#pragma once

#include <vector>

#include "core/vec.h"

namespace octolux {

struct Point2 {
  double x = 0, y = 0;
};

/// Corners of the hull, anticlockwise, without points on its edges or repeated ones. Fewer than
/// three if all points are on a line. Uses `points` as scratch space.
std::vector<Point2> convex_hull(std::vector<Point2>& points);

/// Area of the polygon within the disc of `radius` around the origin; infinite radius: all of it.
/// Corners anticlockwise.
double polygon_area(const std::vector<Point2>& corners, double radius);

}  // namespace octolux
