// pixels.h. All pixels of a pass put their sample at the same place of their square, the next point
// of a low-discrepancy sequence; the picture of the pass is the filtered grid of these samples.
#include "renderer/pixels.h"

#include <atomic>
#include <cmath>

#include "renderer/shared_gathers.h"
#include "renderer/tiles.h"

namespace octolux {

namespace {

/// Point `index` of the R2 sequence (Roberts 2018), shifted by the seed. It goes both ways.
Vec2 sub_pixel(std::uint64_t seed, std::int64_t index) {
  Rng rng(seed, Stream::eye, ~std::uint64_t{0}, 0);
  const Vec2 shift = rng.uniform2();
  const auto place = [&](float start, double step) {
    const double p = start + static_cast<double>(index % (1 << 20)) * step;
    return std::min(kOneMinusEpsilon, static_cast<float>(p - std::floor(p)));
  };
  return {place(shift.x, 0.7548776662466927), place(shift.y, 0.5698402909980532)};
}

/// What a sample weighs in the picture.
struct Share {
  float indirect;
  float rest;  // of which there may be more samples
};

void add(EyeSample& sum, const EyeSample& s, Share share) {
  sum.direct += s.direct * share.rest;
  sum.caustic += s.caustic * share.rest;
  sum.indirect += s.indirect * share.indirect;
  sum.albedo += s.albedo * share.rest;
  sum.normal += s.normal * share.rest;
  sum.depth += s.depth * share.rest;
}

/// The grid of samples, one per pixel, all at `offset` within their pixel.
struct SampleGrid {
  int width, height;
  Vec2 offset;
  PassImage samples;

  const EyeSample& at(int x, int y) const {
    return samples[static_cast<std::size_t>(y) * width + x];
  }
};

/// What a pixel's neighbours along one axis weigh in it: as all samples of a grid lie at the same
/// place of their pixels, the same for every pixel.
class FilterWeights {
 public:
  FilterWeights(const Filter& filter, float offset) {
    const int reach = static_cast<int>(std::ceil(filter.reach() + 0.5f));
    for (int i = -reach; i <= reach; ++i) {
      const float weight = filter.profile(static_cast<float>(i) + offset - 0.5f);
      if (weight == 0 && weights_.empty()) continue;
      if (weights_.empty()) first_ = i;
      weights_.push_back(weight);
      if (weight != 0) last_ = i;
    }
  }
  /// Those of `size` pixels that pixel x reaches, from begin to before end.
  int begin(int x) const { return std::max(0, x + first_); }
  int end(int x, int size) const { return std::min(size, x + last_ + 1); }
  /// Of pixel i in pixel x.
  float operator()(int i, int x) const {
    return weights_[static_cast<std::size_t>(i - x - first_)];
  }

 private:
  int first_ = 0, last_ = -1;
  std::vector<float> weights_;
};

/// Adds the filtered grid's value at pixel (x, y), times `share`.
void add_filtered(EyeSample& out, const SampleGrid& grid, const FilterWeights& across,
                  const FilterWeights& down, int x, int y, Share share) {
  EyeSample sum;
  float total = 0;
  for (int j = down.begin(y); j < down.end(y, grid.height); ++j) {
    for (int i = across.begin(x); i < across.end(x, grid.width); ++i) {
      const float weight = down(j, y) * across(i, x);
      const EyeSample& sample = grid.at(i, j);
      if (weight == 0 || !is_finite(sample.radiance())) continue;
      add(sum, sample, {weight, weight});
      total += weight;
    }
  }
  if (total > 0) add(out, sum, {share.indirect / total, share.rest / total});
}

/// Traces path(tracer, ray, pixel) for every pixel, its sample number `number` of the whole render,
/// at `offset` within the pixel.
template <class Path>
SampleGrid trace_grid(const Scene& scene, std::uint64_t seed, std::uint64_t number, Vec2 offset,
                      PixelPass& pass, Path path) {
  SampleGrid grid{scene.film.crop_width, scene.film.crop_height, offset,
                  PassImage(pass.image.size())};
  std::atomic<std::int64_t> rays{0};
  for_each_pixel(grid.width, grid.height, [&](int x, int y) {
    const std::size_t pixel = static_cast<std::size_t>(y) * grid.width + x;
    Tracer tracer(scene, Rng(seed, Stream::eye, number, pixel));
    tracer.sequence = {seed, pixel, number};
    const Vec2 corner{static_cast<float>(x), static_cast<float>(y)};
    const Vec2 lens = scene.camera.has_lens() ? tracer.sequence.points(PixelUse::lens, 0, 1)[0]
                                              : Vec2{0.5f, 0.5f};
    grid.samples[pixel] = path(tracer, scene.camera.ray(corner + grid.offset, lens), pixel);
    rays.fetch_add(tracer.rays(), std::memory_order_relaxed);
  });
  pass.rays += rays;
  return grid;
}

/// Adds what was gathered to what each path saw.
void add_shared(SampleGrid& grid, const GatheredGrid& gathered, const GatherSharing& sharing,
                float shrink) {
  const SharedGathers neighbours(gathered, sharing, shrink);
  for_each_pixel(grid.width, grid.height, [&](int x, int y) {
    const Gathered& own = gathered.at(x, y);
    if (!own.diffuse) return;
    EyeSample& sample = grid.samples[static_cast<std::size_t>(y) * grid.width + x];
    sample.indirect += own.seen(neighbours.shared(x, y));
  });
}

void note_non_finite(const SampleGrid& grid, PixelPass& pass) {
  for (std::size_t i = 0; i < grid.samples.size(); ++i) {
    if (is_finite(grid.samples[i].radiance())) continue;
    if (pass.non_finite++ == 0) pass.first_non_finite = i;
  }
}

/// Adds the grid to the picture of the pass.
void add_grid(PixelPass& pass, const Scene& scene, const SampleGrid& grid, Share share) {
  note_non_finite(grid, pass);
  const FilterWeights across(scene.filter, grid.offset.x), down(scene.filter, grid.offset.y);
  for_each_pixel(grid.width, grid.height, [&](int x, int y) {
    EyeSample& out = pass.image[static_cast<std::size_t>(y) * grid.width + x];
    add_filtered(out, grid, across, down, x, y, share);
  });
}

/// One sample of each pixel, with what neighbours share.
SampleGrid trace_full(const Scene& scene, PassKey key, std::uint64_t number, const EyePaths& paths,
                      const GatherSharing& sharing, float shrink, PixelPass& pass) {
  GatheredGrid gathered{scene.film.crop_width, scene.film.crop_height,
                        std::vector<Gathered>(sharing.any() ? pass.image.size() : 0)};
  const Vec2 offset = sub_pixel(key.seed, static_cast<std::int64_t>(number));
  SampleGrid grid = trace_grid(
      scene, key.seed, number, offset, pass,
      [&](Tracer& tracer, const Ray& ray, std::size_t pixel) {
        return paths.full(tracer, ray, sharing.any() ? &gathered.pixels[pixel] : nullptr);
      });
  if (sharing.any()) add_shared(grid, gathered, sharing, shrink);
  return grid;
}

/// One of direct light and caustics alone. Its sequences are its own, so that what gathers stays
/// evenly spread whatever their number; but the places in the pixel go on from those of the full
/// samples, backwards, so that all together are the sequence that either is.
SampleGrid trace_direct(const Scene& scene, PassKey key, std::int64_t number, const EyePaths& paths,
                        PixelPass& pass) {
  const std::uint64_t seed = hash64(key.seed ^ static_cast<std::uint64_t>(Stream::direct));
  return trace_grid(
      scene, seed, static_cast<std::uint64_t>(number), sub_pixel(key.seed, -1 - number), pass,
      [&](Tracer& tracer, const Ray& ray, std::size_t) { return paths.direct(tracer, ray); });
}

}  // namespace

PixelPass trace_pixels(const Scene& scene, const SamplePlan& plan, PassKey key,
                       const EyePaths& paths, const GatherSharing& sharing, float shrink) {
  PixelPass pass;
  pass.image.resize(static_cast<std::size_t>(scene.film.crop_width) * scene.film.crop_height);
  const float each = 1.0f / static_cast<float>(plan.full);
  const float rest = each / static_cast<float>(1 + plan.direct);
  for (int s = 0; s < plan.full; ++s) {
    const std::uint64_t number = key.pass * static_cast<std::uint64_t>(plan.full) + s;
    add_grid(pass, scene, trace_full(scene, key, number, paths, sharing, shrink, pass),
             {each, rest});
  }
  for (std::int64_t s = 0; s < plan.full * plan.direct; ++s) {
    const SampleGrid grid = trace_direct(scene, key, plan.direct_before + s, paths, pass);
    add_grid(pass, scene, grid, {0, rest});
  }
  return pass;
}

void describe_first_hit(EyeSample& out, const Scene& scene, const SurfaceHit& hit, const Ray& ray) {
  out.albedo = hit.bsdf->albedo(hit.point);
  out.normal = dot(hit.point.ns, ray.direction) > 0 ? -hit.point.ns : hit.point.ns;
  out.depth = dot(hit.point.position - ray.origin, scene.camera.forward());
}

}  // namespace octolux
