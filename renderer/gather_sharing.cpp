// gather_sharing.h.
#include "renderer/gather_sharing.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/scattering.h"
#include "renderer/roulette.h"
#include "renderer/tiles.h"
#include "renderer/tracer.h"

namespace octolux {

namespace {

constexpr int kMostPixels = 3;       // how far apart pixels may be that share
constexpr float kMinCosine = 0.95f;  // between their normals
constexpr int kProbeRays = 2;        // from each pixel
constexpr int kProbePixels = 2;      // how far apart pixels may be that are probed together

/// What lies around the surface at one pixel.
struct Probe {
  Vec3 normal;
  float nearness = 0;  // [1/m] mean inverse distance
  bool lambertian = false;
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

/// A pixel, seen through its middle.
Probe probe(const Scene& scene, Tracer& tracer, Vec2 pixel) {
  Probe out;
  const Ray ray = scene.camera.ray(pixel, {0.5f, 0.5f});
  Rgb weight(1);
  int segments = 0;
  const std::optional<SurfaceHit> hit = tracer.next(ray, weight, segments);
  if (!hit) return out;
  const Scattering at(hit->point, *hit->bsdf, -ray.direction, Carried::radiance);
  out.lambertian = at.diffuse_reflectance().has_value();
  out.normal = at.facing_shading_normal();
  for (int i = 0; out.lambertian && i < kProbeRays; ++i) {
    const std::optional<BsdfSample> s = sample_lobes(tracer.rng, at, Lobes::smooth);
    if (!s) continue;
    const std::optional<SurfaceHit> end = tracer.next(at.spawn(s->wi), weight, segments);
    if (end && end->distance > 0) out.nearness += 1 / (end->distance * kProbeRays);
  }
  return out;
}

/// The harmonic mean distance [m] of what lies around a pixel's surface; infinite under a free sky.
float distance_around(const ProbeGrid& grid, int x, int y) {
  const Probe& center = grid.probes[grid.index(x, y)];
  float nearness = 0, count = 0;
  for (int j = std::max(0, y - kProbePixels); j <= std::min(grid.height - 1, y + kProbePixels);
       ++j) {
    for (int i = std::max(0, x - kProbePixels); i <= std::min(grid.width - 1, x + kProbePixels);
         ++i) {
      const Probe& other = grid.probes[grid.index(i, j)];
      if (!other.lambertian || !(dot(other.normal, center.normal) > kMinCosine)) continue;
      nearness += other.nearness;
      count += 1;
    }
  }
  return count / nearness;
}

}  // namespace

Rgb GatherSharing::shared(const GatheredGrid& grid, int x, int y, float shrink) const {
  const Gathered& center = grid.at(x, y);
  const float reach = shrink * reach_[static_cast<std::size_t>(&center - grid.pixels.data())];
  const float reach2 = reach * reach;
  // Epanechnikov's kernel of the distance; 0 for pixels that do not know what the center asks.
  const auto weight = [&](int i, int j) {
    if (i < 0 || i >= grid.width || j < 0 || j >= grid.height) return 0.0f;
    const Gathered& other = grid.at(i, j);
    if (!other.lambertian || other.segments != center.segments) return 0.0f;
    if (!is_finite(other.radiance)) return 0.0f;
    for (int c = 0; c < 3; ++c) {
      if (center.reflectance[c] > 0 && !(other.reflectance[c] > 0)) return 0.0f;
    }
    if (!(dot(other.normal, center.normal) > kMinCosine)) return 0.0f;
    const float distance2 = length2(other.position - center.position);
    return distance2 < reach2 ? 1 - distance2 / reach2 : 0.0f;
  };
  Rgb sum = center.radiance;
  float total = 1;
  for (int j = 0; j <= kMostPixels; ++j) {
    for (int i = j == 0 ? 1 : -kMostPixels; i <= kMostPixels; ++i) {
      const float each = std::min(weight(x + i, y + j), weight(x - i, y - j));
      if (!(each > 0)) continue;
      sum += (grid.at(x + i, y + j).radiance + grid.at(x - i, y - j).radiance) * each;
      total += 2 * each;
    }
  }
  return sum / total;
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
  std::vector<float> reach(grid.probes.size());
  for_each_pixel(grid.width, grid.height, [&](int x, int y) {
    const std::size_t pixel = grid.index(x, y);
    if (!grid.probes[pixel].lambertian) return;
    const float distance = distance_around(grid, x, y);
    reach[pixel] = std::min(std::numeric_limits<float>::max(),
                            static_cast<float>(config.eye.share) * distance);
  });
  return GatherSharing(std::move(reach));
}

}  // namespace octolux
