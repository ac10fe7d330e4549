// pixels.h. All pixels of a pass put their sample at the same place of their square, the next point
// of a low-discrepancy sequence; the picture of the pass is the filtered grid of these samples.
#include "renderer/pixels.h"

#include <atomic>
#include <cmath>

#include "renderer/tiles.h"

namespace octolux {

namespace {

/// Point `index` of the R2 sequence (Roberts 2018), shifted by the seed.
Vec2 sub_pixel(std::uint64_t seed, std::uint64_t index) {
  Rng rng(seed, Stream::eye, ~std::uint64_t{0}, 0);
  const Vec2 shift = rng.uniform2();
  const auto place = [&](float start, double step) {
    const double p = start + static_cast<double>(index % (1u << 20)) * step;
    return std::min(kOneMinusEpsilon, static_cast<float>(p - std::floor(p)));
  };
  return {place(shift.x, 0.7548776662466927), place(shift.y, 0.5698402909980532)};
}

void add(EyeSample& sum, const EyeSample& s, float weight) {
  sum.direct += s.direct * weight;
  sum.caustic += s.caustic * weight;
  sum.indirect += s.indirect * weight;
  sum.albedo += s.albedo * weight;
  sum.normal += s.normal * weight;
  sum.depth += s.depth * weight;
}

/// The grid of samples, one per pixel, all at `offset` within their pixel.
struct SampleGrid {
  int width, height;
  Vec2 offset;
  PassImage samples;
  GatheredGrid gathered;  // empty if nothing is shared

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
                  const FilterWeights& down, int x, int y, float share) {
  EyeSample sum;
  float total = 0;
  for (int j = down.begin(y); j < down.end(y, grid.height); ++j) {
    for (int i = across.begin(x); i < across.end(x, grid.width); ++i) {
      const float weight = down(j, y) * across(i, x);
      const EyeSample& sample = grid.at(i, j);
      if (weight == 0 || !is_finite(sample.radiance())) continue;
      add(sum, sample, weight);
      total += weight;
    }
  }
  if (total > 0) add(out, sum, share / total);
}

/// Traces sample number `number` (of the whole render) of every pixel, what may be shared apart.
SampleGrid trace_grid(const Scene& scene, PassKey key, std::uint64_t number,
                      const EyePathFunction& path, bool share, PixelPass& pass) {
  const int width = scene.film.crop_width, height = scene.film.crop_height;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  SampleGrid grid{width,
                  height,
                  sub_pixel(key.seed, number),
                  PassImage(pixels),
                  {width, height, std::vector<Gathered>(share ? pixels : 0)}};
  std::atomic<std::int64_t> rays{0};
  for_each_pixel(grid.width, grid.height, [&](int x, int y) {
    const std::size_t pixel = static_cast<std::size_t>(y) * grid.width + x;
    Tracer tracer(scene, Rng(key.seed, Stream::eye, number, pixel));
    tracer.sequence = {key.seed, pixel, number};
    const Vec2 corner{static_cast<float>(x), static_cast<float>(y)};
    const Vec2 lens = scene.camera.has_lens() ? tracer.sequence.points(PixelUse::lens, 0, 1)[0]
                                              : Vec2{0.5f, 0.5f};
    grid.samples[pixel] = path(tracer, scene.camera.ray(corner + grid.offset, lens),
                               share ? &grid.gathered.pixels[pixel] : nullptr);
    rays.fetch_add(tracer.rays(), std::memory_order_relaxed);
  });
  pass.rays += rays;
  return grid;
}

/// Adds what was gathered to what each path saw.
void add_shared(SampleGrid& grid, const GatherSharing& sharing, float shrink) {
  for_each_pixel(grid.width, grid.height, [&](int x, int y) {
    const Gathered& own = grid.gathered.at(x, y);
    if (!own.lambertian) return;
    EyeSample& sample = grid.samples[static_cast<std::size_t>(y) * grid.width + x];
    sample.indirect += own.seen(sharing.shared(grid.gathered, x, y, shrink));
  });
}

void note_non_finite(const SampleGrid& grid, PixelPass& pass) {
  for (std::size_t i = 0; i < grid.samples.size(); ++i) {
    if (is_finite(grid.samples[i].radiance())) continue;
    if (pass.non_finite++ == 0) pass.first_non_finite = i;
  }
}

}  // namespace

PixelPass trace_pixels(const Scene& scene, int samples, PassKey key, const EyePathFunction& path,
                       const GatherSharing& sharing, float shrink) {
  PixelPass pass;
  pass.image.resize(static_cast<std::size_t>(scene.film.crop_width) * scene.film.crop_height);
  const float share = 1.0f / static_cast<float>(samples);
  for (int s = 0; s < samples; ++s) {
    const std::uint64_t number = key.pass * static_cast<std::uint64_t>(samples) + s;
    SampleGrid grid = trace_grid(scene, key, number, path, sharing.any(), pass);
    if (sharing.any()) add_shared(grid, sharing, shrink);
    note_non_finite(grid, pass);
    const FilterWeights across(scene.filter, grid.offset.x), down(scene.filter, grid.offset.y);
    for_each_pixel(grid.width, grid.height, [&](int x, int y) {
      EyeSample& out = pass.image[static_cast<std::size_t>(y) * grid.width + x];
      add_filtered(out, grid, across, down, x, y, share);
    });
  }
  return pass;
}

void describe_first_hit(EyeSample& out, const Scene& scene, const SurfaceHit& hit, const Ray& ray) {
  out.albedo = hit.bsdf->albedo(hit.point);
  out.normal = dot(hit.point.ns, ray.direction) > 0 ? -hit.point.ns : hit.point.ns;
  out.depth = dot(hit.point.position - ray.origin, scene.camera.forward());
}

}  // namespace octolux
