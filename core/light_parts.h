// A mesh that emits, cut into parts: single triangles, or groups of neighbours where there are very
// many. A choice among lights that knows distances and normals can then choose within the mesh, too
// (renderer/light_sampler.h): of a lamp's bulb the side that faces the point, of a long light band
// what is near. Inside a part points are uniform by area.
//
// Immutable, so thread-safe.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/light.h"
#include "core/vec3d.h"

namespace octolux {

/// `pdf_a` [m^-2] at y as density [sr^-1] of directions at x; 0 where y's front does not face x.
inline float to_pdf_w(double pdf_a, Vec3 x, const SurfacePoint& y) {
  const Vec3d to_x = Vec3d(x) - Vec3d(y.position);
  const double distance2 = dot(to_x, to_x);
  const double distance_cos = dot(Vec3d(y.ng), to_x);
  if (!(distance_cos > 0)) return 0;
  return static_cast<float>(pdf_a * distance2 * std::sqrt(distance2) / distance_cos);
}

class MeshParts {
 public:
  /// At most `most` parts, at least one. `mesh` (whose area is not 0) and `light`, which is that
  /// mesh, must outlive this.
  MeshParts(const TriangleMesh& mesh, const AreaLight& light, int most);

  int size() const { return static_cast<int>(begin_.size()) - 1; }
  /// The part's share of the mesh's area; may be 0.
  double share(int part) const;
  LightExtent extent(int part) const;

  /// As Light::sample, but of one part.
  std::optional<LightSample> sample(int part, Vec3 x, Vec2 u) const;
  int part_of(std::uint32_t primitive) const { return part_of_[primitive]; }
  /// Density [sr^-1] with which `sample`, of the part y is on, chooses the direction towards y.
  float pdf_w(Vec3 x, const SurfacePoint& y) const;

 private:
  void split(std::span<std::uint32_t> triangles, int parts);
  double area(int part) const { return sum_[begin_[part + 1]] - sum_[begin_[part]]; }
  std::uint32_t choose(int part, float& u) const;

  const TriangleMesh& mesh_;
  const AreaLight& light_;
  std::vector<std::uint32_t> order_;  // triangles, part by part
  std::vector<double> sum_;           // [m^2] area of all before this place of `order_`
  std::vector<std::size_t> begin_;    // of each part in `order_`, and the end
  std::vector<int> part_of_;          // per triangle
};

}  // namespace octolux
