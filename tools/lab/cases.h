// The laboratory's cases: photons with a known irradiance around a query, and the surfaces they lie
// on. A case is laid out in the plane: pieces of lit floor and the walls that stand on them.
//
// The query is at the origin. Lengths are in units of the bandwidth: photons are so dense that the
// (n+1)th nearest one is at a distance of about 1. The irradiance at the query is 1.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "estimators/convex_hull.h"

namespace octolux {

/// Convex, corners anticlockwise. Irradiance at (x, y) is `irradiance + slope x`.
struct FloorPiece {
  std::vector<Point2> corners;
  double irradiance = 1;
  double slope = 0;
  bool near = true;  // on the query's side of every wall
};

/// Stands upright on the line from `from` to `to`; lit on its left side.
struct LabWall {
  Point2 from, to;
  double irradiance = 0;
};

struct LabLayout {
  std::vector<FloorPiece> pieces;
  std::vector<LabWall> walls;
  double curvature = 0;      // 1/radius of the cylinder the plane is bent to; > 0: query inside
  double power_decades = 0;  // photons' powers are spread over so many decades, evenly in log
};

struct LabCase {
  const char* name;
  const char* help;
  double distance;  // defaults
  double size;
  LabLayout (*layout)(double distance, double size);
};

std::span<const LabCase> lab_cases();
/// Throws Error for an unknown name.
const LabCase& find_lab_case(const std::string& name);

/// The case's name with the parameters it has.
std::string lab_title(const LabCase& lab_case, double distance, double size);

bool contains(const FloorPiece& piece, Point2 p);
/// Floor within the disc of `radius` on the query's side, weighted by irradiance.
double near_flux(const LabLayout& layout, double radius);

}  // namespace octolux
