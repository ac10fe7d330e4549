// The layouts. Far away means kFar: much farther than any look-up reaches.
#include "tools/lab/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace octolux {
namespace {

constexpr double kFar = 200;

FloorPiece rectangle(Point2 low, Point2 high) {
  return {{{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}};
}

FloorPiece half_plane(double from_x) { return rectangle({from_x, -kFar}, {kFar, kFar}); }

LabLayout plane(double, double) { return {{half_plane(-kFar)}, {}}; }

LabLayout wall(double distance, double) {
  return {{half_plane(-distance)}, {{{-distance, kFar}, {-distance, -kFar}}}};
}

LabLayout edge(double distance, double) { return {{half_plane(-distance)}, {}}; }

LabLayout corner(double distance, double) {
  const double d = -distance;
  return {{rectangle({d, d}, {kFar, kFar})}, {{{d, kFar}, {d, d}}, {{d, d}, {kFar, d}}}};
}

LabLayout lit_corner(double distance, double size) {
  LabLayout layout = corner(distance, size);
  for (LabWall& w : layout.walls) w.irradiance = size;
  return layout;
}

LabLayout reentrant(double distance, double) {
  const double d = distance;
  return {{rectangle({-kFar, -kFar}, {d, kFar}), rectangle({d, -kFar}, {kFar, d})},
          {{{d, d}, {d, kFar}}, {{kFar, d}, {d, d}}}};
}

LabLayout strip(double distance, double size) {
  const double low = -distance * size, high = low + size;
  return {{rectangle({low, -kFar}, {high, kFar})},
          {{{low, kFar}, {low, -kFar}}, {{high, -kFar}, {high, kFar}}}};
}

LabLayout wedge(double distance, double size) {
  if (!(size < 360)) throw Error("a wedge must have less than 360 degrees");
  const double half = size / 2 * std::numbers::pi / 180;
  const Point2 apex{-distance, 0}, ahead{kFar - distance, 0};
  const Point2 low{apex.x + kFar * std::cos(half), -kFar * std::sin(half)};
  const Point2 high{low.x, -low.y};
  const std::vector<LabWall> walls{{high, apex}, {apex, low}};
  if (size < 180) return {{FloorPiece{{apex, low, high}}}, walls};
  return {{FloorPiece{{apex, low, ahead}}, FloorPiece{{apex, ahead, high}}}, walls};
}

LabLayout round_table(double distance, double size) {
  constexpr int kSides = 720;
  FloorPiece top;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    top.corners.push_back({size - distance + size * std::cos(angle), size * std::sin(angle)});
  }
  return {{top}, {}};
}

LabLayout gradient(double, double size) {
  FloorPiece floor = rectangle({-1 / size, -kFar}, {1 / size, kFar});
  floor.slope = size;
  return {{floor}, {}};
}

LabLayout thin_wall(double distance, double size) {
  FloorPiece behind = rectangle({-kFar, -kFar}, {-distance - size, kFar});
  behind.irradiance = 10;
  behind.near = false;
  LabLayout layout = wall(distance, size);
  layout.pieces.push_back(behind);
  layout.walls.push_back({{-distance - size, -kFar}, {-distance - size, kFar}});
  return layout;
}

LabLayout bent(double curvature) {
  const double half = 0.75 * std::numbers::pi / std::abs(curvature);
  return {{rectangle({-half, -kFar}, {half, kFar})}, {}, curvature};
}
LabLayout concave(double, double size) { return bent(1 / size); }
LabLayout convex(double, double size) { return bent(-1 / size); }

LabLayout powers(double, double size) { return {{half_plane(-kFar)}, {}, 0, size}; }

constexpr LabCase kCases[] = {
    {"plane", "open plane", 0, 0, plane},
    {"wall", "a wall at the distance", 0, 0, wall},
    {"corner", "two walls at a right angle, both at the distance", 0, 0, corner},
    {"reentrant", "a pillar's corner: three quarters of the plane are free", 0, 0, reentrant},
    {"strip", "a corridor as wide as the size; distance 0.5 is its middle, 0 at a wall", 0.5, 0.3,
     strip},
    {"wedge", "two walls at an angle of the size [degrees, below 360], the apex at the distance", 0,
     60, wedge},
    {"edge", "a free straight edge at the distance", 0, 0, edge},
    {"disc-edge", "a round table top of the size's radius, its rim at the distance", 0.2, 2,
     round_table},
    {"gradient", "irradiance 1 + size x, dark at one end", 0, 0.3, gradient},
    {"two-walls", "a corner whose walls have photons too, their irradiance is the size", 0.2, 3,
     lit_corner},
    {"thin-wall", "a wall as thick as the size, ten times the light behind it", 0.2, 0.05,
     thin_wall},
    {"concave", "inside a cylinder of the size's radius", 0, 3, concave},
    {"convex", "outside a cylinder of the size's radius", 0, 3, convex},
    {"powers", "open plane, photons' powers spread over the size's decades", 0, 3, powers},
};

}  // namespace

std::span<const LabCase> lab_cases() { return kCases; }

const LabCase& find_lab_case(const std::string& name) {
  std::vector<std::string> names;
  for (const LabCase& known : kCases) {
    if (name == known.name) return known;
    names.emplace_back(known.name);
  }
  throw Error(unknown_name("case", name, names));
}

std::string lab_title(const LabCase& lab_case, double distance, double size) {
  std::string title = lab_case.name;
  if (distance > 0) title += fmt::format(" at {:g}", distance);
  if (lab_case.size > 0) title += fmt::format(" size {:g}", size);
  return title;
}

bool contains(const FloorPiece& piece, Point2 p) {
  for (std::size_t i = 0; i < piece.corners.size(); ++i) {
    const Point2 a = piece.corners[i], b = piece.corners[(i + 1) % piece.corners.size()];
    if (!((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0)) return false;
  }
  return true;
}

double near_flux(const LabLayout& layout, double radius) {
  double flux = 0;
  for (const FloorPiece& piece : layout.pieces) {
    if (piece.near) flux += piece.irradiance * polygon_area(piece.corners, radius);
  }
  return flux;
}

}  // namespace octolux
