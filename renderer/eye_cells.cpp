// eye_cells.h: one kd-tree per facing, split at the median of the longest side.
#include "renderer/eye_cells.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "renderer/glance.h"
#include "renderer/tracer.h"

namespace octolux {

namespace {

constexpr std::size_t kCellLookUps = 32;  // at most
constexpr float kMargin = 0.1f;           // of a cell's diagonal
/// What is nearer to a point than this share of the point's distance to the eye is not told apart.
constexpr float kNear = 1 / 16.0f;

constexpr std::int64_t kEyePaths = 8192;
constexpr int kGatherRays = 2;
constexpr std::int64_t kChunk = 256;  // eye paths

Vec3 eye_of(const Scene& scene) { return scene.camera_config.to_world.point({0, 0, 0}); }

}  // namespace

int EyeCells::facing(Vec3 normal) {
  const Vec3 a = abs(normal);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return 2 * axis + (normal[axis] < 0 ? 1 : 0);
}

EyeCells::EyeCells(std::vector<LookUp> look_ups, Vec3 eye) {
  auto begin = look_ups.begin();
  for (int f = 0; f < kFacings; ++f) {
    const auto end = std::stable_partition(begin, look_ups.end(),
                                           [f](const LookUp& l) { return facing(l.normal) == f; });
    if (begin == end) continue;
    roots_[static_cast<std::size_t>(f)] = static_cast<int>(nodes_.size());
    build({begin, end}, eye);
    begin = end;
  }
}

void EyeCells::build(std::span<LookUp> look_ups, Vec3 eye) {
  const std::size_t here = nodes_.size();
  nodes_.emplace_back();
  Bounds bounds;
  for (const LookUp& l : look_ups) bounds.add(l.position);
  const Vec3 size = bounds.upper - bounds.lower;
  const int axis = bounds.longest_axis();
  const float small = kNear * length(bounds.center() - eye);
  if (look_ups.size() <= kCellLookUps || !(size[axis] > small)) {
    const float margin = kMargin * length(size);
    const Vec3 wide{margin, margin, margin};
    nodes_[here].other = static_cast<int>(cells_.size());
    cells_.push_back(
        {{bounds.lower - wide, bounds.upper + wide}, static_cast<int>(look_ups.size())});
    return;
  }
  const std::size_t half = look_ups.size() / 2;
  std::nth_element(
      look_ups.begin(), look_ups.begin() + static_cast<std::ptrdiff_t>(half), look_ups.end(),
      [axis](const LookUp& a, const LookUp& b) { return a.position[axis] < b.position[axis]; });
  const float split = look_ups[half].position[axis];
  build(look_ups.first(half), eye);
  nodes_[here] = {axis, split, static_cast<int>(nodes_.size())};
  build(look_ups.subspan(half), eye);
}

int EyeCells::find(Vec3 position, Vec3 normal) const {
  int n = roots_[static_cast<std::size_t>(facing(normal))];
  if (n < 0) return -1;
  while (nodes_[static_cast<std::size_t>(n)].axis >= 0) {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    n = position[node.axis] < node.split ? n + 1 : node.other;
  }
  const int cell = nodes_[static_cast<std::size_t>(n)].other;
  const Bounds& b = cells_[static_cast<std::size_t>(cell)].bounds;
  const bool inside = min(b.lower, position) == b.lower && max(b.upper, position) == b.upper;
  return inside ? cell : -1;
}

void look_once(Tracer& tracer, PhotonKind kind, const std::function<void(const Scattering&)>& see) {
  const Vec3 eye = eye_of(tracer.scene());
  follow_to_smooth(tracer, random_eye_ray(tracer.scene(), tracer.rng), [&](const Scattering& at) {
    if (kind != PhotonKind::global) return see(at);
    gather_from(tracer, at, kGatherRays, [&](const Scattering& there) {
      const Vec3 p = at.point().position, q = there.point().position;
      if (!(length(q - p) < kNear * length(p - eye))) see(there);
    });
  });
}

EyeCells look_around(const Scene& scene, PhotonKind kind, std::uint64_t seed) {
  std::vector<std::vector<LookUp>> parts(kEyePaths / kChunk);
  parallel_for_chunks(
      kEyePaths, kChunk, [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
        std::vector<LookUp>& part = parts[static_cast<std::size_t>(chunk)];
        for (std::int64_t i = begin; i < end; ++i) {
          Tracer tracer(scene, Rng(seed, Stream::learning, 0, static_cast<std::uint64_t>(i)));
          look_once(tracer, kind, [&part](const Scattering& at) {
            part.push_back({at.point().position, at.facing_normal()});
          });
        }
      });
  std::vector<LookUp> all;
  for (const std::vector<LookUp>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return EyeCells(std::move(all), eye_of(scene));
}

}  // namespace octolux
