// light_parts.h: groups by halving at the median of the longest side.
#include "core/light_parts.h"

#include <algorithm>
#include <numeric>

#include "core/sampling.h"

namespace octolux {

namespace {

Vec3d corner(const TriangleMesh& mesh, std::uint32_t triangle, int i) {
  return Vec3d(mesh.positions[mesh.triangles[triangle][static_cast<std::size_t>(i)]]);
}

double triangle_area(const TriangleMesh& mesh, std::uint32_t t) {
  const Vec3d p = corner(mesh, t, 0);
  return length(cross(corner(mesh, t, 1) - p, corner(mesh, t, 2) - p)) / 2;
}

float center_along(const TriangleMesh& mesh, std::uint32_t t, int axis) {
  float sum = 0;
  for (const std::uint32_t vertex : mesh.triangles[t]) sum += mesh.positions[vertex][axis];
  return sum;  // thrice the centre's coordinate
}

int longest_side(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  Bounds box;
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t vertex : mesh.triangles[t]) box.add(mesh.positions[vertex]);
  }
  const Vec3 side = box.upper - box.lower;
  return side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
}

}  // namespace

MeshParts::MeshParts(const TriangleMesh& mesh, const AreaLight& light, int most)
    : mesh_(mesh), light_(light), order_(mesh.triangles.size()), part_of_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  begin_.push_back(0);
  const auto count = static_cast<std::int64_t>(order_.size());
  split(order_, static_cast<int>(std::clamp<std::int64_t>(count, 1, most)));
  sum_.push_back(0);
  for (const std::uint32_t t : order_) sum_.push_back(sum_.back() + triangle_area(mesh, t));
}

/// Cuts `triangles` (of `order_`, up to whose beginning all is cut) into as many parts.
void MeshParts::split(std::span<std::uint32_t> triangles, int parts) {
  if (parts <= 1) {
    for (const std::uint32_t t : triangles) part_of_[t] = size();
    begin_.push_back(begin_.back() + triangles.size());
    return;
  }
  const int axis = longest_side(mesh_, triangles);
  const int first = parts / 2;
  const std::size_t middle =
      triangles.size() * static_cast<std::size_t>(first) / static_cast<std::size_t>(parts);
  std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(middle),
                   triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
                     const float at_a = center_along(mesh_, a, axis);
                     const float at_b = center_along(mesh_, b, axis);
                     return at_a < at_b || (at_a == at_b && a < b);
                   });
  split(triangles.first(middle), first);
  split(triangles.subspan(middle), parts - first);
}

double MeshParts::share(int part) const { return area(part) / sum_.back(); }

LightExtent MeshParts::extent(int part) const {
  const std::span<const std::uint32_t> triangles(order_.data() + begin_[part],
                                                 begin_[part + 1] - begin_[part]);
  LightExtent extent;
  Vec3d sum;
  for (const std::uint32_t t : triangles) {
    const double area = triangle_area(mesh_, t);
    if (area > 0) sum = sum + Vec3d(surface_point(mesh_, t, 0, 0).ng) * area;
    for (const std::uint32_t vertex : mesh_.triangles[t]) {
      extent.bounds.add(mesh_.positions[vertex]);
    }
  }
  extent.axis = unit_or(sum, {0, 0, 1});
  extent.normals = 0;
  for (const std::uint32_t t : triangles) {
    if (!(triangle_area(mesh_, t) > 0)) continue;
    const Vec3d n(surface_point(mesh_, t, 0, 0).ng), axis(extent.axis);
    const auto angle = static_cast<float>(std::atan2(length(cross(n, axis)), dot(n, axis)));
    extent.normals = std::max(extent.normals, angle);
  }
  return extent;
}

/// A triangle of the part by area; `u` is stretched to [0, 1) again.
std::uint32_t MeshParts::choose(int part, float& u) const {
  const auto first = sum_.begin() + static_cast<std::ptrdiff_t>(begin_[part]);
  const auto last = sum_.begin() + static_cast<std::ptrdiff_t>(begin_[part + 1]);
  const double place = *first + static_cast<double>(u) * area(part);
  auto next = std::upper_bound(first + 1, last, place);  // the sum behind the triangle
  while (next != last && *next == *(next - 1)) ++next;
  const double before = *(next - 1), own = *next - before;
  u = own > 0 ? std::clamp(static_cast<float>((place - before) / own), 0.0f, kOneMinusEpsilon) : 0;
  return order_[static_cast<std::size_t>(next - 1 - sum_.begin())];
}

std::optional<LightSample> MeshParts::sample(int part, Vec3 x, Vec2 u) const {
  if (!(area(part) > 0)) return std::nullopt;
  const std::uint32_t triangle = choose(part, u.x);
  const Vec2 b = sample_triangle(u);
  LightSample s;
  s.at = surface_point(mesh_, triangle, b.x, b.y);
  s.pdf_w = to_pdf_w(1 / area(part), x, s.at);
  if (!(s.pdf_w > 0) || std::isinf(s.pdf_w)) return std::nullopt;
  s.wi = unit_or(Vec3d(s.at.position) - Vec3d(x), {0, 0, 1});
  s.radiance = light_.radiance(s.at, -s.wi);
  return s;
}

float MeshParts::pdf_w(Vec3 x, const SurfacePoint& y) const {
  const double size = area(part_of_[y.primitive]);
  return size > 0 ? to_pdf_w(1 / size, x, y) : 0;
}

}  // namespace octolux
