// Geometry of a scene: triangle meshes and exact quadrics, and what a point on them looks like to
// everything else (SurfacePoint). Finding the point is accel/'s work.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/affine.h"
#include "core/constants.h"
#include "core/rgb.h"
#include "core/texture_point.h"
#include "core/vec.h"

namespace octolux {

/// A point on a surface, ready for shading.
struct SurfacePoint {
  Vec3 position;
  Vec3 ng;                  // geometric normal, unit, on the front side of the surface
  Vec3 ns;                  // shading normal, unit, dot(ng, ns) >= 0
  TexturePoint uv;          // texture coordinates
  Vec3 dp_du, dp_dv;        // [m] change of position with uv; 0 unless asked for (see tangents)
  float error = 0;          // [m] bound on the error of `position`
  std::uint32_t shape = 0;  // as the ray caster numbers them (RayHit)
  std::uint32_t primitive = 0;
};

/// A quantity that a mesh carries besides its geometry, at its vertices (interpolated) or faces.
struct MeshAttribute {
  std::string name;  // as the file names it, "vertex_color" or "face_color"
  bool per_face = false;
  std::vector<Rgb> values;  // one per vertex or per triangle
};

/// Triangles in world space. `normals` and `uvs` are per vertex or empty. The front side is the one
/// the vertex normals are on, or without them the one from which the triangle runs anticlockwise.
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<MeshAttribute> attributes = {};  // only those that a texture reads
};

/// An exact curved (or round) shape under any invertible affine map, in Mitsuba's conventions: unit
/// sphere; unit disk in z = 0 facing +z; cylinder x^2 + y^2 = 1, z in [0, 1].
struct Quadric {
  enum class Kind { sphere, disk, cylinder };
  Kind kind = Kind::sphere;
  Affine to_world;
  Affine to_object;   // inverse of to_world
  bool flip = false;  // front side inwards (sphere, cylinder) or -z (disk)
};

struct Bounds {
  Vec3 lower{kInfinity, kInfinity, kInfinity};
  Vec3 upper{-kInfinity, -kInfinity, -kInfinity};

  void add(Vec3 p) { lower = min(lower, p), upper = max(upper, p); }
  void add(const Bounds& b) { lower = min(lower, b.lower), upper = max(upper, b.upper); }
  bool empty() const { return !(lower.x <= upper.x); }
  Vec3 center() const { return (lower + upper) * 0.5f; }
  /// Of the longest side.
  int longest_axis() const {
    const Vec3 side = upper - lower;
    return side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
  }
  float radius() const { return empty() ? 0 : length(upper - lower) * 0.5f; }
};

/// One object of the scene: geometry, and indices into the scene's tables.
struct Shape {
  std::variant<TriangleMesh, Quadric> geometry;
  int bsdf = -1;
  int light = -1;    // the area light this shape is, or -1
  std::string name;  // for messages
  int group = -1;    // the group it belongs to (core/instance.h), or -1: it stands in the world
};

/// Where a ray met a quadric, in object space.
struct QuadricHit {
  float t = 0;    // ray parameter, in units of the ray's direction
  Vec3 position;  // on the unit shape
};

/// First hit with t in (t_min, t_max). `origin`, `direction` are in world space. Solved in double.
std::optional<QuadricHit> intersect(const Quadric& quadric, Vec3 origin, Vec3 direction,
                                    float t_min, float t_max);

/// The point of triangle `primitive` with barycentrics (u, v): p = (1-u-v) p0 + u p1 + v p2.
SurfacePoint surface_point(const TriangleMesh& mesh, std::uint32_t primitive, float u, float v);

/// The point of the quadric at `object_position` (on the unit shape).
SurfacePoint surface_point(const Quadric& quadric, Vec3 object_position);

/// How the position changes with uv [m].
struct Tangents {
  Vec3 dp_du, dp_dv;
};
/// Of a triangle; without texture coordinates any two directions in its plane, unit and orthogonal.
Tangents tangents(const TriangleMesh& mesh, std::uint32_t primitive);
/// Of a quadric at `object_position` (on the unit shape).
Tangents tangents(const Quadric& quadric, Vec3 object_position);

Bounds bounds(const Shape& shape);
/// Area [m^2]: exact for meshes; for quadrics by quadrature, relative error below 1e-4.
double area(const Shape& shape);
/// Triangles, or 1 for a quadric.
std::size_t primitive_count(const Shape& shape);

}  // namespace octolux
