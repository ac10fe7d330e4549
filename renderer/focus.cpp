// focus.h. Medians, so that a view out of a window does not count.
#include "renderer/focus.h"

#include <algorithm>
#include <vector>

#include "renderer/scene.h"

namespace octolux {

namespace {

constexpr int kSide = 32;  // rays along each side of the film

std::vector<Vec3> seen_points(const Scene& scene) {
  std::vector<Vec3> points;
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto column = static_cast<float>(i % kSide), row = static_cast<float>(i / kSide);
    const Vec2 pixel{(column + 0.5f) / kSide * static_cast<float>(scene.film.crop_width),
                     (row + 0.5f) / kSide * static_cast<float>(scene.film.crop_height)};
    const Ray ray = scene.camera.ray(pixel, {0.5f, 0.5f});
    const std::optional<RayHit> hit = scene.caster->closest(ray);
    if (hit) points.push_back(ray.origin + ray.direction * hit->t);
  }
  return points;
}

/// Of value(point).
template <class Value>
float median(const std::vector<Vec3>& points, const Value& value) {
  std::vector<float> values;
  for (const Vec3 p : points) values.push_back(value(p));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::optional<Focus> find_focus(const Scene& scene) {
  const std::vector<Vec3> points = seen_points(scene);
  if (points.empty()) return std::nullopt;
  const Vec3 center{median(points, [](Vec3 p) { return p.x; }),
                    median(points, [](Vec3 p) { return p.y; }),
                    median(points, [](Vec3 p) { return p.z; })};
  return Focus{center, median(points, [center](Vec3 p) { return length(p - center); })};
}

}  // namespace octolux
