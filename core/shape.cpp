// Triangles, and the functions that look at any shape. What a quadric does is in quadric.cpp.
//
// Points and normals are computed in double and rounded once, so the error of a position is half a
// unit in the last place of each coordinate. The bound handed on is larger, because it must also
// cover what the ray caster makes of the next ray (see core/ray.h). Stateless, so thread-safe.
#include "core/shape.h"

#include "core/quadric.h"
#include "core/ray.h"
#include "core/vec3d.h"

namespace octolux {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Perpendicular to the triangle, anticlockwise side; twice its area long.
Vec3d double_area_vector(const TriangleMesh& mesh, const Corners& corner) {
  const Vec3d p0(mesh.positions[corner[0]]);
  return cross(Vec3d(mesh.positions[corner[1]]) - p0, Vec3d(mesh.positions[corner[2]]) - p0);
}

template <typename T>
auto interpolate(const std::vector<T>& values, const Corners& corner, float u, float v) {
  return values[corner[0]] * (1 - u - v) + values[corner[1]] * u + values[corner[2]] * v;
}

/// Sets ng and ns: the vertex normals decide which side is the front, and are dropped where they
/// are useless.
void set_normals(const TriangleMesh& mesh, const Corners& corner, Vec2 b, SurfacePoint& point) {
  const Vec3d face = double_area_vector(mesh, corner);
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
  SurfacePoint point;
  point.primitive = primitive;
  const Vec3d origin(p0);
  point.position =
      to_float(origin + (Vec3d(p1) - origin) * u + (Vec3d(p2) - origin) * static_cast<double>(v));
  point.error = position_error_bound(max(abs(p0), max(abs(p1), abs(p2))));
  set_normals(mesh, corner, {u, v}, point);
  point.uv = mesh.uvs.empty() ? Vec2{u, v} : interpolate(mesh.uvs, corner, u, v);
  return point;
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
  for (const Corners& corner : mesh.triangles) sum += length(double_area_vector(mesh, corner)) / 2;
  return sum;
}

std::size_t primitive_count(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
  return mesh ? mesh->triangles.size() : 1;
}

}  // namespace octolux
