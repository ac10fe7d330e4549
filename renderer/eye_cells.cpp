// eye_cells.h: one kd-tree per facing, split at the median of the longest side.
#include "renderer/eye_cells.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "renderer/roulette.h"
#include "renderer/tracer.h"

namespace octolux {

namespace {

constexpr std::size_t kCellLookUps = 32;  // at most
constexpr float kMargin = 0.1f;           // of a cell's diagonal

constexpr std::int64_t kEyePaths = 8192;
constexpr int kGatherRays = 2;
constexpr std::int64_t kChunk = 256;  // eye paths
constexpr int kMaxBounces = 32;       // specular ones, without roulette

float component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Follows `ray` through specular lobes to the first smooth ones, and adds that place. Then, from
/// there, `gather_rays` times once more.
void look(Tracer& tracer, Ray ray, int gather_rays, std::vector<LookUp>& found) {
  Rgb beta(1);
  for (int bounces = 0, segments = 0; bounces < kMaxBounces; ++bounces) {
    const std::optional<SurfaceHit> hit = tracer.next(ray, beta, segments);
    if (!hit) return;
    const Scattering at(hit->point, *hit->bsdf, -ray.direction, Carried::radiance);
    if (hit->bsdf->has(Lobes::smooth)) {
      if (gather_rays == 0) found.push_back({hit->point.position, at.facing_normal()});
      for (int i = 0; i < gather_rays; ++i) {
        const std::optional<BsdfSample> s = sample_lobes(tracer.rng, at, Lobes::smooth);
        if (s) look(tracer, at.spawn(s->wi), 0, found);
      }
      return;
    }
    const std::optional<BsdfSample> s = sample_lobes(tracer.rng, at, Lobes::specular);
    if (!s) return;
    ray = at.spawn(s->wi);
  }
}

}  // namespace

int EyeCells::facing(Vec3 normal) {
  const Vec3 a = abs(normal);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return 2 * axis + (component(normal, axis) < 0 ? 1 : 0);
}

EyeCells::EyeCells(std::vector<LookUp> look_ups) {
  auto begin = look_ups.begin();
  for (int f = 0; f < kFacings; ++f) {
    const auto end = std::stable_partition(begin, look_ups.end(),
                                           [f](const LookUp& l) { return facing(l.normal) == f; });
    if (begin == end) continue;
    roots_[static_cast<std::size_t>(f)] = static_cast<int>(nodes_.size());
    build({begin, end});
    begin = end;
  }
}

void EyeCells::build(std::span<LookUp> look_ups) {
  const std::size_t here = nodes_.size();
  nodes_.emplace_back();
  Bounds bounds;
  for (const LookUp& l : look_ups) bounds.add(l.position);
  const Vec3 size = bounds.upper - bounds.lower;
  const int axis = facing(size) / 2;
  if (look_ups.size() <= kCellLookUps || !(component(size, axis) > 0)) {
    const float margin = kMargin * length(size);
    const Vec3 wide{margin, margin, margin};
    nodes_[here].other = static_cast<int>(cells_.size());
    cells_.push_back(
        {{bounds.lower - wide, bounds.upper + wide}, static_cast<int>(look_ups.size())});
    return;
  }
  const std::size_t half = look_ups.size() / 2;
  std::nth_element(look_ups.begin(), look_ups.begin() + static_cast<std::ptrdiff_t>(half),
                   look_ups.end(), [axis](const LookUp& a, const LookUp& b) {
                     return component(a.position, axis) < component(b.position, axis);
                   });
  const float split = component(look_ups[half].position, axis);
  build(look_ups.first(half));
  nodes_[here] = {axis, split, static_cast<int>(nodes_.size())};
  build(look_ups.subspan(half));
}

int EyeCells::find(Vec3 position, Vec3 normal) const {
  int n = roots_[static_cast<std::size_t>(facing(normal))];
  if (n < 0) return -1;
  while (nodes_[static_cast<std::size_t>(n)].axis >= 0) {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    n = component(position, node.axis) < node.split ? n + 1 : node.other;
  }
  const int cell = nodes_[static_cast<std::size_t>(n)].other;
  const Bounds& b = cells_[static_cast<std::size_t>(cell)].bounds;
  const bool inside = min(b.lower, position) == b.lower && max(b.upper, position) == b.upper;
  return inside ? cell : -1;
}

EyeCells look_around(const Scene& scene, PhotonKind kind, bool gather, std::uint64_t seed) {
  const int gather_rays = kind == PhotonKind::global && gather ? kGatherRays : 0;
  std::vector<std::vector<LookUp>> parts(kEyePaths / kChunk);
  parallel_for_chunks(kEyePaths, kChunk,
                      [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
                        for (std::int64_t i = begin; i < end; ++i) {
                          const auto index = static_cast<std::uint64_t>(i);
                          Tracer tracer(scene, Rng(seed, Stream::learning, 0, index));
                          const Vec2 u = tracer.rng.uniform2();
                          const Vec2 lens = tracer.rng.uniform2();
                          const Vec2 pixel{u.x * static_cast<float>(scene.film.crop_width),
                                           u.y * static_cast<float>(scene.film.crop_height)};
                          look(tracer, scene.camera.ray(pixel, lens), gather_rays,
                               parts[static_cast<std::size_t>(chunk)]);
                        }
                      });
  std::vector<LookUp> all;
  for (const std::vector<LookUp>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return EyeCells(std::move(all));
}

}  // namespace octolux
