// focus.h. Medians, so that a view out of a window does not count.
#include "renderer/focus.h"

#include <algorithm>
#include <vector>

#include "renderer/eye_cells.h"

namespace octolux {

namespace {

constexpr std::uint64_t kEyePaths = 1024;
constexpr std::size_t kFewest = 64;  // points; fewer tell nothing

/// Where the global map will be read; the same in every render of a scene.
std::vector<Vec3> read_points(const Scene& scene) {
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; i < kEyePaths; ++i) {
    Tracer tracer(scene, Rng(0, Stream::learning, 1, i));
    look_once(tracer, PhotonKind::global,
              [&points](const Scattering& at) { points.push_back(at.point().position); });
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
  const std::vector<Vec3> points = read_points(scene);
  if (points.size() < kFewest) return std::nullopt;
  const Vec3 center{median(points, [](Vec3 p) { return p.x; }),
                    median(points, [](Vec3 p) { return p.y; }),
                    median(points, [](Vec3 p) { return p.z; })};
  return Focus{center, median(points, [center](Vec3 p) { return length(p - center); })};
}

}  // namespace octolux
