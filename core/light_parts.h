// A mesh that emits, cut into parts: single triangles, or groups of neighbours where there are very
// many. A choice among lights that knows distances and normals can then choose within the mesh, too
// (renderer/light_sampler.h): of a lamp's bulb the side that faces the point, of a long light band
// what is near. Inside a part points are uniform by area.
//
// Immutable, so thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/light.h"
#include "core/mesh_patch.h"

namespace octolux {

class MeshParts {
 public:
  /// At most `most` parts, at least one. `mesh` (whose area is not 0) and `light`, which is that
  /// mesh, must outlive this.
  MeshParts(const TriangleMesh& mesh, const AreaLight& light, int most);

  int size() const { return static_cast<int>(parts_.size()); }
  /// The part's share of the mesh's area; may be 0.
  double share(int part) const { return patch(part).area() / area_; }
  LightExtent extent(int part) const { return patch(part).extent(); }

  /// As Light::sample, but of one part.
  std::optional<LightSample> sample(int part, Vec3 x, Vec2 u) const;
  int part_of(std::uint32_t primitive) const { return part_of_[primitive]; }
  /// Density [sr^-1] with which `sample`, of the part y is on, chooses the direction towards y.
  float pdf_w(Vec3 x, const SurfacePoint& y) const;

 private:
  const MeshPatch& patch(int part) const { return parts_[static_cast<std::size_t>(part)]; }
  void split(const TriangleMesh& mesh, std::span<std::uint32_t> triangles, int parts);

  const AreaLight& light_;
  std::vector<MeshPatch> parts_;
  std::vector<int> part_of_;  // per triangle
  double area_ = 0;           // [m^2] of all parts
};

}  // namespace octolux
