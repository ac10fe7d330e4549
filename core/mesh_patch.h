// Some triangles of a mesh that emits, or all: points uniform by area, and where they look.
// Immutable, so thread-safe.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distribution.h"
#include "core/light.h"
#include "core/shape.h"

namespace octolux {

class MeshPatch {
 public:
  /// `mesh` must outlive this.
  MeshPatch(const TriangleMesh& mesh, std::vector<std::uint32_t> triangles);

  double area() const { return by_area_.total(); }  // [m^2]
  /// Uniform by area, which must not be 0; `u` in [0, 1)^2.
  SurfacePoint point(Vec2 u) const;
  /// Of the triangles that have any area.
  LightExtent extent() const;

 private:
  template <class See>
  void for_each_face(const See& see) const;

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> triangles_;
  Distribution1D by_area_;
};

}  // namespace octolux
