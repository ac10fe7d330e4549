// gather_sharing.h.
#include "renderer/gather_sharing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "core/scattering.h"
#include "renderer/roulette.h"
#include "renderer/tiles.h"
#include "renderer/tracer.h"

namespace octolux {

namespace {

constexpr float kMinCosine = 0.95f;  // between normals of pixels that are probed together
constexpr int kProbeRays = 2;        // from each pixel
constexpr int kProbeBounces = 8;     // by specular lobes
constexpr int kProbePixels = 2;      // how far apart pixels may be that are probed together

Vec3 squares(Vec3 v) { return {v.x * v.x, v.y * v.y, v.z * v.z}; }
Vec3 products(Vec3 v) { return {v.y * v.z, v.z * v.x, v.x * v.y}; }

/// What lies around the surface at one pixel.
struct Probe {
  struct End {
    float inverse = 0;  // [1/m] of the distance; 0: the ray left the scene
    Vec3 normal;
  };
  Vec3 position, normal;
  Way way;
  std::array<End, kProbeRays> ends;
  bool diffuse = false;
};

/// One of each pixel.
struct ProbeGrid {
  int width, height;
  std::vector<Probe> probes;

  ProbeGrid(int width_, int height_) : width(width_), height(height_), probes(index(0, height_)) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// Looks around from `at`.
void look_around(Tracer& tracer, const Scattering& at, Probe& out) {
  out.diffuse = true;
  out.position = at.point().position;
  out.normal = at.facing_shading_normal();
  for (Probe::End& seen : out.ends) {
    const std::optional<BsdfSample> s = sample_lobes(tracer.rng, at, Lobes::smooth);
    if (!s) continue;
    Rgb weight(1);
    int segments = 0;
    const std::optional<SurfaceHit> end = tracer.next(at.spawn(s->wi), weight, segments);
    if (end && end->distance > 0) seen = {1 / end->distance, end->point.ng};
  }
}

/// A pixel, seen through its middle, and in mirrors and glass the way most light goes.
Probe probe(const Scene& scene, Tracer& tracer, Vec2 pixel) {
  Probe out;
  Ray ray = scene.camera.ray(pixel, {0.5f, 0.5f});
  Rgb weight(1);
  int segments = 0;
  for (int bounces = 0; bounces <= kProbeBounces; ++bounces) {
    const std::optional<SurfaceHit> hit = tracer.next(ray, weight, segments);
    if (!hit) break;
    const Scattering at(hit->point, *hit->bsdf, -ray.direction, Carried::radiance);
    if (at.diffuse_reflectance() || at.coated_reflectance()) {
      look_around(tracer, at, out);
      break;
    }
    const std::optional<BsdfSample> s = at.sample(0.5f, {0.5f, 0.5f}, Lobes::specular);
    if (!s) break;
    out.way.add(at.transmits(s->wi));
    ray = at.spawn(s->wi);
  }
  return out;
}

/// Do pixels show one surface, or nearly so?
bool alike(const Probe& a, const Probe& b) {
  return a.diffuse && b.diffuse && a.way == b.way && dot(a.normal, b.normal) > kMinCosine;
}

/// [m] from the surface at a pixel to that at the nearest one beside it; infinite if it ends there.
float spacing(const ProbeGrid& grid, int x, int y) {
  const Probe& center = grid.probes[grid.index(x, y)];
  float nearest = std::numeric_limits<float>::infinity();
  for (const auto& [i, j] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
    if (i < 0 || j < 0 || i >= grid.width || j >= grid.height) continue;
    const Probe& other = grid.probes[grid.index(i, j)];
    if (alike(center, other)) {
      nearest = std::min(nearest, length(other.position - center.position));
    }
  }
  return nearest;
}

/// Mean over what lies around a pixel's surface. Along surfaces nothing is nearer than `least`
/// times the pixels' spacing.
Nearness mean_nearness(const ProbeGrid& grid, int x, int y, float least) {
  const Probe& center = grid.probes[grid.index(x, y)];
  const float most = 1 / (least * spacing(grid, x, y));
  Nearness nearness;
  float count = 0;
  for (int j = std::max(0, y - kProbePixels); j <= std::min(grid.height - 1, y + kProbePixels);
       ++j) {
    for (int i = std::max(0, x - kProbePixels); i <= std::min(grid.width - 1, x + kProbePixels);
         ++i) {
      const Probe& other = grid.probes[grid.index(i, j)];
      if (!alike(center, other)) continue;
      for (const Probe::End& end : other.ends) nearness.add(end.inverse, end.normal, most);
      count += kProbeRays;
    }
  }
  return nearness * (1 / count);
}

}  // namespace

void Nearness::add(float inverse, Vec3 normal, float most) {
  const float even = std::min(inverse, most), excess = inverse - even;
  even_ += even;
  squares_ += squares(normal) * excess;
  products_ += products(normal) * excess;
}

Nearness Nearness::operator*(float factor) const {
  Nearness scaled(even_ * factor);
  scaled.squares_ = squares_ * factor;
  scaled.products_ = products_ * factor;
  return scaled;
}

float Nearness::times(Vec3 d) const {
  const float distance = length(d);
  if (!(distance > 0)) return 0;
  const float across = dot(squares_, squares(d)) + 2 * dot(products_, products(d));
  return even_ * distance + across / distance;
}

GatherSharing learn_sharing(const Scene& scene, const RenderConfig& config) {
  if (!config.eye.gather || !(config.eye.share > 0)) return {};
  ProbeGrid grid(scene.film.crop_width, scene.film.crop_height);
  for_each_pixel(grid.width, grid.height, [&](int x, int y) {
    const std::size_t pixel = grid.index(x, y);
    Tracer tracer(scene, Rng(config.seed, Stream::sharing, 0, pixel));
    grid.probes[pixel] =
        probe(scene, tracer, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
  });
  const auto share = static_cast<float>(config.eye.share);
  std::vector<SharingLimit> limits(grid.probes.size());
  for_each_pixel(grid.width, grid.height, [&](int x, int y) {
    const std::size_t pixel = grid.index(x, y);
    if (!grid.probes[pixel].diffuse) return;
    limits[pixel] = {mean_nearness(grid, x, y, kAlongPixels / share) * (1 / share),
                     grid.probes[pixel].way};
  });
  return GatherSharing(std::move(limits));
}

}  // namespace octolux
