// masks.h.
#include "tools/ab/masks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/parallel.h"
#include "estimators/feelers.h"
#include "estimators/region_search.h"
#include "renderer/photon_pass.h"
#include "renderer/tracer.h"

namespace octolux {
namespace {

constexpr std::int64_t kChunk = 256;  // pixels
constexpr int kTurns = 4;             // of eight feelers each

/// Radiance below this share of the reference's mean is none: far below what any picture shows, and
/// above what rounding leaves of nothing in a reference from elsewhere.
constexpr double kDarkShare = 1e-6;

/// The widest map of a render, and what it is read in.
struct Look {
  const Scene& scene;
  const RenderConfig& config;
  RadianceMap map;
  double reach;
};

bool is_near_edge(const Look& look, GatherPoint point, float length) {
  for (int i = 0; i < kTurns; ++i) {
    point.turn = static_cast<float>(i) / kTurns;
    FeelerQuery query = feeler_query(point, RayPacket::kSize);
    query.length = length;
    const TangentPlane plane(query);
    Feelers feelers = trace_feelers(*look.scene.caster, query, plane);
    stop_at_edges(*look.scene.caster, query, plane, feelers);
    const auto end = feelers.all.begin() + feelers.count;
    if (!std::all_of(feelers.all.begin(), end, [](const Feeler& f) { return f.open; })) return true;
  }
  return false;
}

/// What there is at a pixel's centre.
struct Sight {
  bool surface = false, near_edge = false, lamp = false;
  float reach = 0;  // [m]
};

Sight look_at(const Look& look, std::int64_t pixel) {
  const int width = look.scene.film.crop_width;
  const Vec2 centre{static_cast<float>(pixel % width) + 0.5f,
                    static_cast<float>(pixel / width) + 0.5f};
  // Random numbers decide only whether the ray passes a half transparent mask.
  const auto index = static_cast<std::uint64_t>(pixel);
  Tracer tracer(look.scene, Rng(look.config.seed, Stream::eye, ~std::uint64_t{1}, index));
  Rgb weight(1);
  int segments = 0;
  const Ray ray = look.scene.camera.ray(centre);
  const std::optional<SurfaceHit> hit = tracer.next(ray, weight, segments);
  Sight sight;
  sight.lamp = hit && hit->light != nullptr;
  if (!hit || !hit->bsdf->has(Lobes::smooth) || is_black(hit->bsdf->albedo(hit->point)))
    return sight;
  const Scattering at(hit->point, *hit->bsdf, -ray.direction, Carried::radiance);
  const GatherPoint point{at, 255, look.scene.caster.get(), 0};
  const float length = static_cast<float>(look.reach) *
                       look.map.bandwidth_at(point, look.config.estimator.neighbours);
  return {true, is_near_edge(look, point, length), sight.lamp, length};
}

/// The first pass's photons; null estimator: only its bandwidths are asked for.
RadianceMap widest_map(const Scene& scene, const RenderConfig& config, const Estimator& estimator) {
  const LightSampler lights(scene);
  PhotonPass traced =
      trace_photons(scene, lights, PhotonKind::global, config.photons.global, {config.seed, 0});
  PhotonMap photons(std::move(traced.photons));
  const Bandwidth bandwidth =
      look_up_bandwidth(scene, config, PhotonKind::global, photons.size(), 0);
  return RadianceMap(std::move(photons), estimator, bandwidth);
}

/// Surfaces the reference leaves dark.
Mask dark_surfaces(const Mask& surface, const LayerView& reference) {
  double mean = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const float y = grey(reference, i);
    if (std::isfinite(y)) mean += y / static_cast<double>(surface.size());
  }
  Mask dark(surface.size(), 0);
  for (std::size_t i = 0; i < dark.size(); ++i) {
    dark[i] = surface[i] != 0 && grey(reference, i) <= kDarkShare * mean;
  }
  return dark;
}

/// Does `is` hold for any of the nine pixels around `pixel`, itself included?
bool any_around(std::int64_t pixel, int width, std::int64_t pixels,
                const std::function<bool(std::size_t)>& is) {
  const auto x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
  const auto height = static_cast<int>(pixels / width);
  for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) {
      if (is(static_cast<std::size_t>(j) * width + i)) return true;
    }
  }
  return false;
}

/// Mean reach [m] over what either mask holds.
double mean_reach(const SeenSurfaces& seen, const Mask& a, const Mask& b) {
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < seen.reach.size(); ++i) {
    if (a[i] == 0 && b[i] == 0) continue;
    sum += static_cast<double>(seen.reach[i]);
    ++pixels;
  }
  return pixels > 0 ? sum / pixels : 0;
}

}  // namespace

SeenSurfaces see_surfaces(const Scene& scene, const RenderConfig& wanted, double reach) {
  const std::int64_t pixels =
      static_cast<std::int64_t>(scene.film.crop_width) * scene.film.crop_height;
  const RenderConfig config = resolved(wanted, pixels);
  const std::unique_ptr<Estimator> estimator = make_estimator(config.estimator);
  const Look look{scene, config, widest_map(scene, config, *estimator), reach};
  std::vector<Sight> sights(static_cast<std::size_t>(pixels));
  parallel_for_chunks(pixels, kChunk, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) sights[i] = look_at(look, i);
  });
  SeenSurfaces seen;
  seen.bandwidths = reach;
  for (std::int64_t i = 0; i < pixels; ++i) {
    const bool at_lamp = any_around(i, scene.film.crop_width, pixels,
                                    [&](std::size_t at) { return sights[at].lamp; });
    const Sight sight = at_lamp ? Sight{} : sights[i];
    seen.surface.push_back(sight.surface);
    seen.near_edge.push_back(sight.near_edge);
    seen.reach.push_back(sight.reach);
  }
  return seen;
}

std::vector<NamedMask> leak_masks(const SeenSurfaces& seen, const LayerView& reference) {
  const auto pixels = static_cast<std::int64_t>(seen.surface.size());
  const Mask dark = dark_surfaces(seen.surface, reference);
  Mask sealed(seen.surface.size(), 0), walls = sealed, open = sealed;
  for (std::int64_t i = 0; i < pixels; ++i) {
    if (seen.surface[i] == 0) continue;
    const bool lit_around = any_around(i, reference.width, pixels, [&](std::size_t at) {
      return seen.surface[at] != 0 && dark[at] == 0;
    });
    const bool in_sealed = dark[i] != 0 && !lit_around;
    (in_sealed ? sealed : seen.near_edge[i] != 0 ? walls : open)[i] = 1;
  }
  const std::string reach = fmt::format("within {:g} bandwidths, on average {:.2g} m",
                                        seen.bandwidths, mean_reach(seen, walls, open));
  std::vector<NamedMask> masks = {
      {"image", "image", "all pixels", {}},
      {"walls", "near walls", "surfaces with a wall or an edge " + reach, std::move(walls)},
      {"open", "in the open", "lit surfaces with no wall or edge " + reach, std::move(open)},
      {"sealed", "sealed", "surfaces that no light reaches in the reference", std::move(sealed)}};
  for (NamedMask& m : masks) m.pixels = count_pixels(m.mask, seen.surface.size());
  std::erase_if(masks, [](const NamedMask& m) { return m.pixels == 0; });
  return masks;
}

}  // namespace octolux
