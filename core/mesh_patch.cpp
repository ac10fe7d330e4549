// mesh_patch.h.
#include "core/mesh_patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/sampling.h"
#include "core/vec3d.h"

namespace octolux {

namespace {

double triangle_area(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3d p(mesh.positions[a]);
  return length(cross(Vec3d(mesh.positions[b]) - p, Vec3d(mesh.positions[c]) - p)) / 2;
}

}  // namespace

MeshPatch::MeshPatch(const TriangleMesh& mesh, std::vector<std::uint32_t> triangles)
    : mesh_(mesh), triangles_(std::move(triangles)) {
  std::vector<double> areas;
  areas.reserve(triangles_.size());
  for (const std::uint32_t t : triangles_) areas.push_back(triangle_area(mesh, t));
  by_area_ = Distribution1D(areas);
}

SurfacePoint MeshPatch::point(Vec2 u) const {
  const Distribution1D::Sample chosen = by_area_.sample(u.x);
  const Vec2 b = sample_triangle({chosen.u, u.y});
  return surface_point(mesh_, triangles_[static_cast<std::size_t>(chosen.index)], b.x, b.y);
}

/// Calls see(first corner, share of the area) for every triangle that has any.
template <class See>
void MeshPatch::for_each_face(const See& see) const {
  for (int i = 0; i < by_area_.size(); ++i) {
    const float share = by_area_.pmf(i);
    if (share > 0) see(surface_point(mesh_, triangles_[static_cast<std::size_t>(i)], 0, 0), share);
  }
}

LightExtent MeshPatch::extent() const {
  LightExtent extent;
  Vec3d sum;
  for_each_face([&](const SurfacePoint& corner, float share) {
    sum = sum + Vec3d(corner.ng) * static_cast<double>(share);
    for (const std::uint32_t vertex : mesh_.triangles[corner.primitive]) {
      extent.bounds.add(mesh_.positions[vertex]);
    }
  });
  extent.axis = unit_or(sum, {0, 0, 1});
  extent.normals = 0;
  for_each_face([&](const SurfacePoint& corner, float) {
    const Vec3d n(corner.ng), axis(extent.axis);
    const auto angle = static_cast<float>(std::atan2(length(cross(n, axis)), dot(n, axis)));
    extent.normals = std::max(extent.normals, angle);
  });
  return extent;
}

}  // namespace octolux
