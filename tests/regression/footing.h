// What lies behind the pixels of a regression render: the surface, how wide look-ups are there, and
// where it ends.
#pragma once

#include <optional>
#include <vector>

#include "renderer/photon_pass.h"
#include "tests/regression/cases.h"

namespace octolux::test {

/// A pixel's centre on the first surface.
struct Footing {
  Vec3 position, normal;
  float bandwidth = 0;  // h [m]
  float pixel = 0;      // side of the pixel's square there, seen face on [m]
  float extent = 0;     // the same along the surface
};
/// Cosine between normals of one plane: 1, but for rounding and 2.5 degrees.
inline constexpr float kSameNormal = 0.999f;
using Footings = std::vector<std::optional<Footing>>;

inline float measured_bandwidth(const PhotonMap& map, const Footing& at, float limit) {
  constexpr std::size_t kNeighbours = EstimatorConfig{}.neighbours;
  PhotonQuery query{at.position, at.normal};
  query.max_radius = limit;
  NeighbourBuffer buffer;
  const auto found = map.nearest(query, kNeighbours + 1, buffer);
  return found.size() > kNeighbours ? std::sqrt(found.back().distance2) : limit;
}

/// The first surface behind every pixel's centre, with the bandwidth of look-ups there in a first
/// pass of one of the maps.
inline Footings footings(const Scene& scene, const RenderConfig& config, PhotonKind kind) {
  const bool global = kind == PhotonKind::global;
  const PhotonConfig& photons = config.photons;
  const PhotonMap map(trace_photons(scene, LightSampler(scene), kind,
                                    global ? photons.global : photons.caustic, {1, 0})
                          .photons);
  const float limit = look_up_bandwidth(scene, config, kind, map.size(), 0).max_radius;
  const FilmSize& film = scene.film;
  const float tangent = std::tan(scene.camera_config.fov_x_degrees * kPi / 360);
  Footings out;
  for (int i = 0; i < film.crop_width * film.crop_height; ++i) {
    const Ray ray = scene.camera.ray({static_cast<float>(i % film.crop_width) + 0.5f,
                                      static_cast<float>(i / film.crop_width) + 0.5f});
    const std::optional<RayHit> hit = scene.caster->closest(ray);
    std::optional<Footing>& at = out.emplace_back();
    if (!hit) continue;
    const SurfacePoint point = scene.caster->surface(*hit);
    const float cosine = dot(point.ng, ray.direction);
    const float depth = dot(point.position - ray.origin, scene.camera.forward());
    const float pixel = 2 * tangent * depth / static_cast<float>(film.width);
    at = Footing{point.position, cosine < 0 ? point.ng : -point.ng, 0, pixel, 0};
    at->extent = pixel / std::max(0.01f, std::abs(cosine));
    at->bandwidth = measured_bandwidth(map, *at, limit);
  }
  return out;
}

/// Is there another surface, or another albedo, at a neighbour of the pixel?
class Discontinuities {
 public:
  Discontinuities(const Footings& feet, const Image& albedo) : feet_(feet), albedo_(albedo) {
    for (int y = 0; y < albedo.height; ++y) {
      for (int x = 0; x < albedo.width; ++x) marks_.push_back(differs(x, y));
    }
  }
  bool at(std::size_t pixel) const { return marks_[pixel] != 0; }

 private:
  bool differs(int x, int y) const {
    const int w = albedo_.width, h = albedo_.height;
    if (x == 0 || y == 0 || x == w - 1 || y == h - 1) return true;  // who knows what comes next
    const std::size_t here = static_cast<std::size_t>(y) * w + x;
    for (const std::size_t there : {here - 1, here + 1, here - w, here + w}) {
      if (!alike(here, there)) return true;
    }
    return false;
  }
  bool alike(std::size_t a, std::size_t b) const {
    if (!feet_[a] || !feet_[b]) return false;
    const Vec3 way = feet_[b]->position - feet_[a]->position;
    const bool flat = dot(feet_[a]->normal, feet_[b]->normal) > kSameNormal &&
                      std::abs(dot(way, feet_[a]->normal)) < 0.1f * feet_[a]->pixel;
    const Rgb p = albedo_.pixels[a], q = albedo_.pixels[b];
    bool same = true;
    for (int c = 0; c < 3; ++c) same = same && std::abs(p[c] - q[c]) <= 0.01f * p[c];
    return flat && same && mean(p) > 0;
  }

  const Footings& feet_;
  const Image& albedo_;
  std::vector<char> marks_;
};

}  // namespace octolux::test
