// pixels.h.
#include "renderer/pixels.h"

#include <atomic>

#include "core/parallel.h"

namespace octolux {

namespace {

constexpr int kTile = 16;  // pixels

struct Tile {
  int x0, y0, x1, y1;
};

Tile tile_at(const FilmSize& film, std::int64_t index) {
  const int across = (film.crop_width + kTile - 1) / kTile;
  const int x0 = static_cast<int>(index % across) * kTile;
  const int y0 = static_cast<int>(index / across) * kTile;
  return {x0, y0, std::min(film.crop_width, x0 + kTile), std::min(film.crop_height, y0 + kTile)};
}

void add(EyeSample& sum, const EyeSample& s, float weight) {
  sum.direct += s.direct * weight;
  sum.caustic += s.caustic * weight;
  sum.indirect += s.indirect * weight;
  sum.albedo += s.albedo * weight;
  sum.normal += s.normal * weight;
  sum.depth += s.depth * weight;
}

}  // namespace

PixelPass trace_pixels(const Scene& scene, int samples, PassKey key, const EyePathFunction& path) {
  const FilmSize& film = scene.film;
  PixelPass result;
  result.image.resize(static_cast<std::size_t>(film.crop_width) * film.crop_height);
  const std::int64_t tiles = static_cast<std::int64_t>((film.crop_width + kTile - 1) / kTile) *
                             ((film.crop_height + kTile - 1) / kTile);
  std::atomic<std::int64_t> rays{0};

  const auto trace_pixel = [&](int x, int y) {
    const std::size_t pixel = static_cast<std::size_t>(y) * film.crop_width + x;
    std::int64_t count = 0;
    for (int s = 0; s < samples; ++s) {
      const std::uint64_t index = pixel * static_cast<std::uint64_t>(samples) + s;
      Tracer tracer(scene, Rng(key.seed, Stream::eye, key.pass, index));
      const Vec2 offset = scene.filter.sample(tracer.rng.uniform2());
      const Ray ray = scene.camera.ray(Vec2{x + 0.5f, y + 0.5f} + offset);
      add(result.image[pixel], path(tracer, ray), 1.0f / static_cast<float>(samples));
      count += tracer.rays();
    }
    return count;
  };
  parallel_for_chunks(tiles, 1, [&](std::int64_t chunk, std::int64_t, std::int64_t) {
    const Tile tile = tile_at(film, chunk);
    std::int64_t count = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) count += trace_pixel(x, y);
    }
    rays += count;
  });
  result.rays = rays;
  return result;
}

void describe_first_hit(EyeSample& out, const Scene& scene, const SurfaceHit& hit, const Ray& ray) {
  out.albedo = hit.bsdf->albedo(hit.point);
  out.normal = dot(hit.point.ns, ray.direction) > 0 ? -hit.point.ns : hit.point.ns;
  out.depth = dot(hit.point.position - ray.origin, scene.camera.forward());
}

}  // namespace octolux
