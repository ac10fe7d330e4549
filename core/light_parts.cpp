// light_parts.h: groups by halving at the median of the longest side.
#include "core/light_parts.h"

#include <algorithm>
#include <numeric>

#include "core/area_sampling.h"

namespace octolux {

namespace {

float center_along(const TriangleMesh& mesh, std::uint32_t t, int axis) {
  float sum = 0;
  for (const std::uint32_t vertex : mesh.triangles[t]) sum += mesh.positions[vertex][axis];
  return sum;  // thrice the centre's coordinate
}

Bounds bounds_of(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  Bounds bounds;
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t vertex : mesh.triangles[t]) bounds.add(mesh.positions[vertex]);
  }
  return bounds;
}

}  // namespace

MeshParts::MeshParts(const TriangleMesh& mesh, const AreaLight& light, int most)
    : light_(light), part_of_(mesh.triangles.size()) {
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  const auto count = static_cast<std::int64_t>(all.size());
  split(mesh, all, static_cast<int>(std::clamp<std::int64_t>(count, 1, most)));
  for (const MeshPatch& part : parts_) area_ += part.area();
}

/// Sorts `triangles` and cuts them into as many parts.
void MeshParts::split(const TriangleMesh& mesh, std::span<std::uint32_t> triangles, int parts) {
  if (parts <= 1) {
    for (const std::uint32_t t : triangles) part_of_[t] = size();
    parts_.emplace_back(mesh, std::vector<std::uint32_t>(triangles.begin(), triangles.end()));
    return;
  }
  const int axis = bounds_of(mesh, triangles).longest_axis();
  const int first = parts / 2;
  const std::size_t middle =
      triangles.size() * static_cast<std::size_t>(first) / static_cast<std::size_t>(parts);
  std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(middle),
                   triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
                     const float at_a = center_along(mesh, a, axis);
                     const float at_b = center_along(mesh, b, axis);
                     return at_a < at_b || (at_a == at_b && a < b);
                   });
  split(mesh, triangles.first(middle), first);
  split(mesh, triangles.subspan(middle), parts - first);
}

std::optional<LightSample> MeshParts::sample(int part, Vec3 x, Vec2 u) const {
  if (!(patch(part).area() > 0)) return std::nullopt;
  const SurfacePoint y = patch(part).point(u);
  return towards(y, x, 1 / patch(part).area(), light_.radiance(y, y.ng));
}

float MeshParts::pdf_w(Vec3 x, const SurfacePoint& y) const {
  const double area = patch(part_of_[y.primitive]).area();
  return area > 0 ? to_pdf_w(1 / area, x, y) : 0;
}

}  // namespace octolux
