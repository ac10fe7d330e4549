// photon_pass.h: the walk, and its cut into chunks that do not depend on threads.
#include "renderer/photon_pass.h"

#include <cmath>

#include "core/parallel.h"
#include "renderer/photon_scatter.h"
#include "renderer/tracer.h"

namespace octolux {

namespace {

constexpr std::int64_t kChunk = 4096;          // paths
constexpr std::int64_t kBatch = 256 * kChunk;  // paths whose chunks are held at a time
constexpr double kSpare = 1.02;                // room for photons beyond those expected

Stream stream_of(PhotonKind kind) {
  switch (kind) {
    case PhotonKind::global:
      return Stream::global_photon;
    case PhotonKind::caustic:
      return Stream::caustic_photon;
    case PhotonKind::record:
      return Stream::record;
    case PhotonKind::guide:
      return Stream::guide;
  }
  return Stream::global_photon;
}

/// Some of the paths of a pass.
struct Batch {
  std::int64_t all = 0;  // paths of the pass
  std::int64_t first = 0, count = 0;
};

/// What its chunks found, in their order.
std::vector<PhotonPass> trace_batch(const Scene& scene, const PhotonSource& source, PhotonKind kind,
                                    Batch batch, PassKey key) {
  const Stream stream = stream_of(kind);
  std::vector<PhotonPass> parts(static_cast<std::size_t>((batch.count + kChunk - 1) / kChunk));
  const auto trace = [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
    PhotonPass& part = parts[static_cast<std::size_t>(chunk)];
    for (std::int64_t index = batch.first + begin; index < batch.first + end; ++index) {
      Tracer tracer(scene, Rng(key.seed, stream, key.pass, static_cast<std::uint64_t>(index)));
      // Stratified over the pass, so that every lamp gets its share.
      const double u =
          (static_cast<double>(index) + tracer.rng.uniform()) / static_cast<double>(batch.all);
      const EmissionDensity::Sample sample = source.density.sample(u, tracer.rng);
      const float photons_like_it = static_cast<float>(batch.all) / sample.weight;
      EmittedPhoton photon = emit_photon(source.lights, sample.at, photons_like_it);
      photon.narrow &= !source.all;
      trace_photon(tracer, photon, kind, part.photons);
      part.rays += tracer.rays();
    }
  };
  parallel_for_chunks(batch.count, kChunk, trace);
  return parts;
}

}  // namespace

/// The light is chosen by power, so that all photons carry about the same flux.
EmittedPhoton emit_photon(const LightSampler& lights, const EmissionPoint& at, float count) {
  const LightSampler::Choice choice = lights.sample_for_emission(at[0]);
  EmittedPhoton photon = choice.light->emit({at[1], at[2]}, {at[3], at[4]});
  photon.flux *= 1 / (choice.pmf * count);
  photon.narrow = choice.light->narrow();
  return photon;
}

void trace_photon(Tracer& tracer, const EmittedPhoton& start, PhotonKind kind,
                  std::vector<Photon>& photons) {
  // A photon is seen over at least one more segment.
  const int max_depth = tracer.scene().max_depth;
  const int max_segments = max_depth < 0 ? 1 << 20 : max_depth - 1;
  const bool caustic = kind == PhotonKind::caustic;
  const int first_stored = caustic || start.narrow ? 1 : 0;  // by bounces before it
  const Lobes followed = caustic ? Lobes::specular : Lobes::all;
  const std::optional<Focus>& focus = tracer.scene().focus;
  Flight flight{start.ray, start.flux};
  for (int bounces = 0; flight.segments < max_segments; ++bounces) {
    const std::optional<SurfaceHit> hit = tracer.next(flight.ray, flight.flux, flight.segments);
    if (!hit || flight.segments > max_segments) return;
    flight.flown += hit->distance;
    const Scattering at(hit->point, *hit->bsdf, -flight.ray.direction, Carried::flux);
    if (hit->bsdf->has(Lobes::smooth) && bounces >= first_stored) {
      photons.push_back({hit->point.position, at.wo(), at.facing_normal(), flight.flux,
                         flight.segments, hit->point.error, at.facing_shading_normal(),
                         flight.scattered ? flight.flown : 0});
    }
    if (!hit->bsdf->has(followed) || !scatter(flight, at, followed, focus, tracer.rng)) return;
  }
}

PhotonPass trace_photons(const Scene& scene, const PhotonSource& source, PhotonKind kind,
                         std::int64_t count, PassKey key) {
  PhotonPass result;
  if (count == 0 || source.lights.empty()) return result;
  if (kind == PhotonKind::caustic && !scene.any_specular) return result;

  // A batch at a time, so that what chunks found is never held twice.
  for (std::int64_t done = 0; done < count;) {
    const std::int64_t batch = std::min(kBatch, count - done);
    const std::vector<PhotonPass> parts =
        trace_batch(scene, source, kind, {count, done, batch}, key);
    done += batch;
    std::size_t total = result.photons.size();
    for (const PhotonPass& part : parts) total += part.photons.size();
    if (total > result.photons.capacity()) {
      // What the rest will need, if it stores as many; memory not written to costs nothing.
      const double share = static_cast<double>(done) / static_cast<double>(count);
      const double all = static_cast<double>(total) / share;
      result.photons.reserve(done < count ? static_cast<std::size_t>(kSpare * all) : total);
    }
    for (const PhotonPass& part : parts) {
      result.photons.insert(result.photons.end(), part.photons.begin(), part.photons.end());
      result.rays += part.rays;
    }
  }
  return result;
}

PhotonPass trace_photons(const Scene& scene, const LightSampler& lights, PhotonKind kind,
                         std::int64_t count, PassKey key) {
  return trace_photons(scene, {lights, EmissionDensity()}, kind, count, key);
}

Bandwidth look_up_bandwidth(const Scene& scene, const RenderConfig& config, PhotonKind kind,
                            std::size_t photons, std::uint64_t pass) {
  const double alpha = config.photons.alpha;
  const double radius =
      kind == PhotonKind::caustic ? config.photons.caustic_radius : config.photons.global_radius;
  const double per_area = std::max(1.0, static_cast<double>(photons)) / scene.total_area;
  const double mean_radius = std::sqrt(config.estimator.neighbours / (std::numbers::pi * per_area));
  Bandwidth bandwidth;
  bandwidth.max_radius = static_cast<float>(
      std::min(radius * mean_radius, 2.0 * static_cast<double>(scene.bounds.radius())));
  double shrink2 = 1;
  for (std::uint64_t k = 1; k <= pass; ++k) {
    shrink2 *= (static_cast<double>(k) + alpha) / (static_cast<double>(k) + 1);
  }
  bandwidth.shrink = static_cast<float>(std::sqrt(shrink2));
  return bandwidth;
}

}  // namespace octolux
