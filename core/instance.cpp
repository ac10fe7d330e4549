// instance.h. Normals go with the inverse transpose, so inside and outside keep their meaning under
// every map.
//
// Error of a placed point p, with A p' + b = p. The point's own error counts by how much the map
// stretches distances along the normal, 1 / |A^-T n|. The ray caster maps the next ray's origin
// into the group's space by a float matrix B = A^-1: coordinate i errs by some units of 2^-24 times
// the sum of |B_ij| (|p_j| + |b_j|). For A = R S, rotation after scaling, that is at most sqrt(3)
// (|p| + |b|) / s_i; along n, stretched, at most 3 (|p| + |b|) whatever S: as if p itself had been
// rounded a few times, like any position (core/ray.h), but b counts too.
#include "core/instance.h"

#include <cmath>
#include <utility>

#include "core/ray.h"

namespace octolux {
namespace {

double column_length(const Affine& a, int j) { return std::hypot(a.m[0][j], a.m[1][j], a.m[2][j]); }

void move(TriangleMesh& mesh, const Affine& to_world, const Affine& inverse) {
  for (Vec3& p : mesh.positions) p = to_world.point(p);
  // Not made unit: interpolated, they are to turn as they would in an instance.
  for (Vec3& n : mesh.normals) n = Affine::normal(inverse, n);
  if (to_world.determinant() < 0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
}

}  // namespace

SurfacePoint place(const SurfacePoint& point, const Instance& instance) {
  SurfacePoint result = point;
  result.position = instance.to_world.point(point.position);
  const Vec3 n = Affine::normal(instance.to_object, point.ng);
  const float stretch = 1 / length(n);
  result.ng = result.ns = n * stretch;
  if (!(point.ns == point.ng)) {
    const Vec3 ns = normalize(Affine::normal(instance.to_object, point.ns));
    if (dot(ns, result.ng) > 0) result.ns = ns;
  }
  const auto& m = instance.to_world.m;
  const Vec3 offset{static_cast<float>(m[0][3]), static_cast<float>(m[1][3]),
                    static_cast<float>(m[2][3])};
  result.error = position_error_bound(abs(result.position) + abs(offset)) + stretch * point.error;
  return result;
}

Bounds place(const Bounds& box, const Affine& to_world) {
  Bounds result;
  if (box.empty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    result.add(to_world.point({corner & 1 ? box.upper.x : box.lower.x,
                               corner & 2 ? box.upper.y : box.lower.y,
                               corner & 4 ? box.upper.z : box.lower.z}));
  }
  return result;
}

Shape moved(Shape shape, const Affine& to_world) {
  const Affine inverse = *to_world.inverse();
  if (auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
    move(*mesh, to_world, inverse);
  } else {
    auto& quadric = std::get<Quadric>(shape.geometry);
    quadric.to_world = to_world * quadric.to_world;
    quadric.to_object = quadric.to_object * inverse;
  }
  return shape;
}

double area(const Shape& shape, const Affine& to_world) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
  if (!mesh) return area(moved(shape, to_world));
  double sum = 0;
  for (const auto& t : mesh->triangles) {
    const Vec3 a = to_world.vector(mesh->positions[t[1]] - mesh->positions[t[0]]);
    const Vec3 b = to_world.vector(mesh->positions[t[2]] - mesh->positions[t[0]]);
    sum += length(cross(a, b)) / 2.0;
  }
  return sum;
}

double skew(const Affine& map) {
  return column_length(map, 0) * column_length(map, 1) * column_length(map, 2) /
         std::abs(map.determinant());
}

}  // namespace octolux
