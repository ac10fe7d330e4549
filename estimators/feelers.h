// Geometry feelers (Tobler & Maierhofer 2006, section 4): rays around a query in its tangent plane,
// which tell how far the surface is free, and what ends it. A part of free_region.h.
//
// A feeler ends at a wall, at a free edge of the surface, or is open. Unlike the paper we keep the
// wall's plane, not only the distance: where it cuts the tangent plane it is a half plane, so that
// a straight wall is known exactly, at any angle. A surface whose normal agrees with the query's is
// no wall but the surface going on (the photon filter counts its photons): on a concave curve the
// feeler hits it at once, and goes on from there, higher.
//
// Tolerances. The lift is the error of the position, twice, plus 2^-10 of the feeler's length, so
// it scales with the scene, with its distance from the origin and with the bandwidth. The second
// term keeps a ray of rounded direction (2^-23 of its length) off its own plane, steps over gaps
// and steps too low to matter to a density (light cannot come from under them), and is below the
// skirting board. An arc whose normals agree to 45 degrees over a distance r rises by at most
// r tan(22.5 degrees) = 0.41 r, so the last lift of 0.42 of the length clears it.
//
// A query in a wall's plane belongs to the side the viewer is on, so feelers start a little that
// way: 32 errors of the position, and lift / 64. No more, because what they say is taken to be seen
// from the query: started two lifts aside, one in 10^6 would pass a far corner on the other side of
// a thin wall. Pure functions.
#pragma once

#include <array>

#include "accel/photon_region.h"
#include "accel/ray_caster.h"
#include "core/frame.h"

namespace octolux {

/// Unit vectors at 0, 45, ... degrees.
inline constexpr std::array<Vec2, 8> kEightDirections{{{1, 0},
                                                       {0.70710678f, 0.70710678f},
                                                       {0, 1},
                                                       {-0.70710678f, 0.70710678f},
                                                       {-1, 0},
                                                       {-0.70710678f, -0.70710678f},
                                                       {0, -1},
                                                       {0.70710678f, -0.70710678f}}};

/// Where to feel, and how far.
struct FeelerQuery {
  SurfacePoint point;
  Vec3 normal;        // geometric, unit, on the viewer's side
  Vec3 wo;            // unit, towards the viewer: that way there is free space for certain
  float length = 0;   // [m] of the feelers, finite
  int feelers = 8;    // 8 or 4
  float turn = 0;     // [0, 1) of the angle between two feelers
  bool edges = true;  // look for free edges, too
};

/// Height [m] of the feelers above the tangent plane.
float feeler_lift(const FeelerQuery& query);

/// The tangent plane of a query, and the tolerances there.
struct TangentPlane {
  Vec3 origin, s, t, n;
  Vec3 start;      // of feelers: above the origin
  float lift = 0;  // [m] of the start above the plane

  explicit TangentPlane(const FeelerQuery& query);
  /// Starts feelers on the way to the viewer if something hangs over the origin, lower than they
  /// are.
  void avoid_overhang(const RayCaster& caster, Vec3 wo);
  Vec2 project(Vec3 p) const { return {dot(p - origin, s), dot(p - origin, t)}; }
  float height(Vec3 p) const { return dot(p - origin, n); }
  Vec3 point(Vec2 p, float above) const { return origin + s * p.x + t * p.y + n * above; }
  Vec3 direction(Vec2 d) const { return s * d.x + t * d.y; }
  /// Does a surface with this normal belong to the query's surface, for the photon filter?
  bool agrees(Vec3 normal) const { return dot(normal, n) > 0.7f; }
  /// The side of a wall that faces the query, in this plane. `p`: a point of it.
  HalfPlane free_side(Vec3 wall_normal, Vec3 p, Vec2 fallback) const;

 private:
  void move_start(Vec3 wo, float way);
  float way_to_viewer(Vec3 wo) const;
};

struct Feeler {
  Vec2 direction;    // unit
  float end = 0;     // [m] how far the surface is free
  bool open = true;  // as far as was asked?
  HalfPlane line;    // what ends it; no finite c: unknown
  float height = 0;  // [m] of the ray above the plane at its end

  Vec2 tip() const { return direction * end; }
  bool has_line() const { return line.c < kInfinity; }
};

struct Feelers {
  std::array<Feeler, RayPacket::kSize> all;
  int count = 0;
};

/// Traces them: one packet, and up to two more where the surface is concave.
Feelers trace_feelers(const RayCaster& caster, const FeelerQuery& query, const TangentPlane& plane);

/// Shortens feelers to where the surface under them ends (surface_edges.cpp).
void stop_at_edges(const RayCaster& caster, const FeelerQuery& query, const TangentPlane& plane,
                   Feelers& feelers);

/// Is there surface under each point of the tangent plane (bits of `lanes`)? Answers as bits.
std::uint32_t surface_at(const RayCaster& caster, const FeelerQuery& query,
                         const TangentPlane& plane,
                         const std::array<Vec2, RayPacket::kSize>& points, std::uint32_t lanes);

}  // namespace octolux
