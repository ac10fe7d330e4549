// Triangles, and the functions that look at any shape. What a quadric does is in quadric.cpp.
//
// Points and normals are computed in double and rounded once, so the error of a position is half a
// unit in the last place of each coordinate. The bound handed on is larger, because it must also
// cover what the ray caster makes of the next ray (see core/ray.h). Stateless, so thread-safe.
#include "core/shape.h"

#include <algorithm>

#include "core/frame.h"
#include "core/quadric.h"
#include "core/ray.h"
#include "core/vec3d.h"

namespace octolux {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A triangle's edges from its first corner; `face` is perpendicular, on the anticlockwise side,
/// and twice its area long.
struct Edges {
  Vec3d a, b, face;

  Edges(const TriangleMesh& mesh, const Corners& corner)
      : a(Vec3d(mesh.positions[corner[1]]) - Vec3d(mesh.positions[corner[0]])),
        b(Vec3d(mesh.positions[corner[2]]) - Vec3d(mesh.positions[corner[0]])),
        face(cross(a, b)) {}
};

/// Error [m] of Embree's distance from a triangle's plane, for rays that start near it. Its normal
/// is the cross product of the two shorter edges e, f, in float: the direction errs by about
/// 2^-24 |e||f| / (2 area), and the third edge g is the lever. |e||f||g| / (2 area) is the diameter
/// of the circumscribed circle: about the longest edge for a triangle of good shape, far more for a
/// sliver. Measured at twice that; limited, so that a needle does not throw rays far away.
double plane_error(const Edges& edges) {
  const Vec3d c = edges.b - edges.a;
  const double a2 = dot(edges.a, edges.a), b2 = dot(edges.b, edges.b), c2 = dot(c, c);
  constexpr double kMaxRatio = 512;
  const double most2 = kMaxRatio * kMaxRatio * std::max(a2, std::max(b2, c2));
  const double diameter2 = a2 * b2 * c2 / dot(edges.face, edges.face);
  return 2 * 0x1p-24 * std::sqrt(diameter2 < most2 ? diameter2 : most2);
}

template <typename T>
auto interpolate(const std::vector<T>& values, const Corners& corner, float u, float v) {
  return values[corner[0]] * (1 - u - v) + values[corner[1]] * u + values[corner[2]] * v;
}

/// Sets ng and ns: the vertex normals decide which side is the front, and are dropped where they
/// are useless.
void set_normals(const TriangleMesh& mesh, const Corners& corner, Vec3d face, Vec2 b,
                 SurfacePoint& point) {
  if (mesh.normals.empty()) {
    point.ng = point.ns = unit_or(face, {0, 0, 1});
    return;
  }
  const Vec3d n0(mesh.normals[corner[0]]), n1(mesh.normals[corner[1]]), n2(mesh.normals[corner[2]]);
  const Vec3d side = n0 + n1 + n2;
  point.ng = unit_or(face, unit_or(side, {0, 0, 1}));
  if (dot(face, side) < 0) point.ng = -point.ng;
  const double u = b.x, v = b.y;
  point.ns = unit_or(n0 * (1 - u - v) + n1 * u + n2 * v, point.ng);
  if (!(dot(point.ns, point.ng) > 0)) point.ns = point.ng;
}

}  // namespace

SurfacePoint surface_point(const TriangleMesh& mesh, std::uint32_t primitive, float u, float v) {
  const Corners& corner = mesh.triangles[primitive];
  const Vec3 p0 = mesh.positions[corner[0]];
  const Vec3 p1 = mesh.positions[corner[1]];
  const Vec3 p2 = mesh.positions[corner[2]];
  const Edges edges(mesh, corner);
  SurfacePoint point;
  point.primitive = primitive;
  point.position = to_float(Vec3d(p0) + edges.a * u + edges.b * v);
  point.error = position_error_bound(max(abs(p0), max(abs(p1), abs(p2)))) +
                static_cast<float>(plane_error(edges));
  set_normals(mesh, corner, edges.face, {u, v}, point);
  const Vec2 uv = mesh.uvs.empty() ? Vec2{u, v} : interpolate(mesh.uvs, corner, u, v);
  point.uv = TexturePoint(uv, mesh, primitive, {u, v});
  return point;
}

Tangents tangents(const TriangleMesh& mesh, std::uint32_t primitive) {
  const Corners& corner = mesh.triangles[primitive];
  const Edges edges(mesh, corner);
  if (!mesh.uvs.empty()) {
    const Vec2 a = mesh.uvs[corner[1]] - mesh.uvs[corner[0]];
    const Vec2 b = mesh.uvs[corner[2]] - mesh.uvs[corner[0]];
    const double determinant = double{a.x} * b.y - double{a.y} * b.x;
    if (determinant != 0) {
      return {to_float((edges.a * b.y - edges.b * a.y) * (1 / determinant)),
              to_float((edges.b * a.x - edges.a * b.x) * (1 / determinant))};
    }
  }
  const Frame frame = Frame::from_normal(unit_or(edges.face, {0, 0, 1}));
  return {frame.s, frame.t};
}

Bounds bounds(const Shape& shape) {
  if (const auto* quadric = std::get_if<Quadric>(&shape.geometry)) return bounds(*quadric);
  const auto& mesh = std::get<TriangleMesh>(shape.geometry);
  Bounds result;
  for (const Corners& corner : mesh.triangles) {
    for (const std::uint32_t vertex : corner) result.add(mesh.positions[vertex]);
  }
  return result;
}

double area(const Shape& shape) {
  if (const auto* quadric = std::get_if<Quadric>(&shape.geometry)) return area(*quadric);
  const auto& mesh = std::get<TriangleMesh>(shape.geometry);
  double sum = 0;
  for (const Corners& corner : mesh.triangles) sum += length(Edges(mesh, corner).face) / 2;
  return sum;
}

std::size_t primitive_count(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
  return mesh ? mesh->triangles.size() : 1;
}

}  // namespace octolux
