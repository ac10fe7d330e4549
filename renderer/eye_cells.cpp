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
/// What is nearer to a point than this share of the point's distance to the eye is not told apart:
/// there the map is not read, but the gather ray goes on (final_gather.h).
constexpr float kNear = 1 / 16.0f;

constexpr std::int64_t kEyePaths = 8192;
constexpr int kGatherRays = 2;
constexpr std::int64_t kChunk = 256;  // eye paths

/// Places found, and the eye that looks.
struct Glances {
  Vec3 eye;
  std::vector<LookUp> found;

  bool near(Vec3 a, Vec3 b) const { return length(a - b) < kNear * length(a - eye); }
};

/// Adds the place where `ray` meets the first smooth lobes. Or else those where gather rays from
/// there read the global map, but for what is near.
void look(Tracer& tracer, const Ray& ray, PhotonKind kind, Glances& glances) {
  follow_to_smooth(tracer, ray, [&](const Scattering& at) {
    if (kind != PhotonKind::global) {
      glances.found.push_back({at.point().position, at.facing_normal()});
      return;
    }
    gather_from(tracer, at, kGatherRays, [&](const Scattering& there) {
      if (glances.near(at.point().position, there.point().position)) return;
      glances.found.push_back({there.point().position, there.facing_normal()});
    });
  });
}

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

EyeCells look_around(const Scene& scene, PhotonKind kind, std::uint64_t seed) {
  const Vec3 eye = scene.camera_config.to_world.point({0, 0, 0});
  std::vector<Glances> parts(kEyePaths / kChunk, Glances{eye, {}});
  parallel_for_chunks(kEyePaths, kChunk,
                      [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
                        for (std::int64_t i = begin; i < end; ++i) {
                          const auto index = static_cast<std::uint64_t>(i);
                          Tracer tracer(scene, Rng(seed, Stream::learning, 0, index));
                          look(tracer, random_eye_ray(scene, tracer.rng), kind,
                               parts[static_cast<std::size_t>(chunk)]);
                        }
                      });
  std::vector<LookUp> all;
  for (const Glances& part : parts) {
    all.insert(all.end(), part.found.begin(), part.found.end());
  }
  return EyeCells(std::move(all), eye);
}

}  // namespace octolux
