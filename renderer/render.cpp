// render.h: the main path of the program. A pass of photon mapping is photons, maps, eye paths; a
// pass of path tracing is eye paths alone.
#include "renderer/render.h"

#include <chrono>

#include "core/check.h"
#include "renderer/caustic_paths.h"
#include "renderer/direct_samples.h"
#include "renderer/eye_pass.h"
#include "renderer/learn_emission.h"
#include "renderer/path_pass.h"
#include "renderer/record_pass.h"

namespace octolux {

namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// Seconds since the last lap, or since the start.
  double lap() {
    const double now = seconds();
    const double lap = now - last_;
    last_ = now;
    return lap;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double last_ = 0;
};

/// The kernel of a render's maps.
std::unique_ptr<Estimator> kernel_of(const RenderConfig& config) {
  EstimatorConfig kernel = config.estimator;
  kernel.seen = config.eye.gather && config.eye.seen;
  return make_estimator(kernel);
}

/// What all passes of a render share.
struct Job {
  Job(const Scene& scene_, const RenderConfig& config_)
      : scene(scene_), config(config_), lights(scene), estimator(kernel_of(config)) {}

  const Scene& scene;
  const RenderConfig& config;
  const LightSampler lights;
  const std::unique_ptr<Estimator> estimator;
  PhotonAim aim;
  Learned learned;
  GatherSharing sharing;

  PassKey key(int pass) const { return {config.seed, static_cast<std::uint64_t>(pass)}; }
};

/// Photons of one kind in their map.
RadianceMap make_map(const Job& job, PhotonKind kind, PassKey key, Progress& progress) {
  const PhotonConfig& photons = job.config.photons;
  const bool global = kind == PhotonKind::global;
  Stopwatch watch;
  const PhotonSource source{job.lights, global ? job.aim.global : job.aim.caustic,
                            !job.config.eye.gather};
  PhotonPass traced =
      trace_photons(job.scene, source, kind, global ? photons.global : photons.caustic, key);
  progress.rays += traced.rays;
  progress.timing.photons += watch.lap();

  PhotonMap map(std::move(traced.photons));
  (global ? progress.global_photons : progress.caustic_photons) =
      static_cast<std::int64_t>(map.size());
  progress.rejected_photons += static_cast<std::int64_t>(map.rejected());
  progress.photon_bytes += static_cast<std::int64_t>(map.memory());
  const Bandwidth bandwidth = look_up_bandwidth(job.scene, job.config, kind, map.size(), key.pass);
  progress.timing.maps += watch.lap();
  return RadianceMap(std::move(map), *job.estimator, bandwidth);
}

/// Records of what gather rays will find in `map`.
GatherRecords make_records(const Job& job, const RadianceMap& map, PassKey key,
                           Progress& progress) {
  const RenderConfig& config = job.config;
  if (!config.eye.gather) return {};
  Stopwatch watch;
  const PhotonSource source{job.lights, job.aim.global, false};
  const RecordPass traced = trace_record_sites(job.scene, source, config, map.bandwidth(), key);
  progress.rays += traced.rays;
  progress.timing.photons += watch.lap();
  RecordConfig records;
  records.neighbours = config.estimator.neighbours;
  if (job.scene.max_depth >= 0)
    records.max_segments = std::clamp(job.scene.max_depth - 2, 0, kMaxSegments);
  records.must_see = job.estimator->sees_geometry();
  records.turn_key = hash64(hash64(key.seed) ^ key.pass);
  RecordSites sites(traced.sites, traced.photons, map.bandwidth(), records.neighbours,
                    config.eye.reuse);
  GatherRecords made(std::move(sites), map, *job.scene.caster, records);
  progress.timing.maps += watch.lap();
  return made;
}

PixelPass photon_mapping_pass(const Job& job, PassKey key, Progress& progress) {
  progress.photon_bytes = 0;
  PhotonMaps maps;
  maps.caustics_mapped = job.config.photons.caustic > 0;
  maps.global = make_map(job, PhotonKind::global, key, progress);
  maps.records = make_records(job, maps.global, key, progress);
  if (job.config.eye.gather) maps.caustic = make_map(job, PhotonKind::caustic, key, progress);

  Stopwatch watch;
  const FinalGather gather(job.scene, job.lights, maps, job.learned, job.config);
  const EyePaths paths{[&](Tracer& tracer, const Ray& ray, Gathered* apart) {
                         return trace_eye_path(tracer, job.lights, gather, ray, apart);
                       },
                       [&](Tracer& tracer, const Ray& ray) {
                         return trace_direct_path(tracer, job.lights, gather, ray);
                       }};
  const SamplePlan plan{job.config.eye.samples_per_pass, progress.direct_samples,
                        progress.direct_grids};
  PixelPass pixels =
      trace_pixels(job.scene, plan, key, paths, job.sharing, maps.global.bandwidth().shrink);
  progress.direct_grids += plan.full * plan.direct;
  progress.rays += pixels.rays;
  progress.timing.eye += watch.lap();
  return pixels;
}

PixelPass path_tracing_pass(const Job& job, PassKey key, Progress& progress) {
  Stopwatch watch;
  const EyePaths paths{[&](Tracer& tracer, const Ray& ray, Gathered*) {
    return trace_path(tracer, job.lights, ray);
  }};
  PixelPass pixels = trace_pixels(job.scene, {job.config.eye.samples_per_pass}, key, paths);
  progress.rays += pixels.rays;
  progress.timing.eye += watch.lap();
  return pixels;
}

/// Adds a pass to the picture. The second tells how many direct samples the next ones take.
void add(const PixelPass& pass, const RenderConfig& config, RenderResult& result) {
  Progress& progress = result.progress;
  const bool automatic = config.eye.direct_samples < 0 && progress.direct_samples > 0;
  if (automatic && result.film.passes() == 1) {
    progress.direct_samples =
        wanted_direct_samples(result.film, pass.image, progress.direct_samples);
  }
  result.film.note_non_finite(pass.non_finite, pass.first_non_finite);
  result.film.add(pass.image);
  ++progress.passes;
  progress.error = result.film.relative_error();
}

}  // namespace

RenderResult render(const Scene& scene, const RenderConfig& wanted, RenderObserver& observer,
                    std::optional<RenderResult> start) {
  check(wanted);
  const FilmSize& film = scene.film;
  RenderConfig config =
      resolved(wanted, static_cast<std::int64_t>(film.crop_width) * film.crop_height);
  if (!has_rule(config.stop)) config.stop = default_stop(config.integrator);
  Job job(scene, config);
  Stopwatch watch;
  if (config.integrator == Integrator::photon) {
    job.aim = learn_emission(scene, job.lights, config);
    config.photons.caustic = caustic_paths(scene, job.lights, job.aim, config);
    const PhotonMemory memory = foresee_photons(scene, job.lights, job.aim, config);
    check_photons(memory, config, physical_memory());
    observer.photons_foreseen(memory);
    job.learned.guides = learn_guides(scene, {job.lights, job.aim.global}, config);
    job.learned.lights = learn_lights(scene, job.lights, config);
    job.sharing = learn_sharing(scene, config);
  }
  RenderResult result =
      start ? std::move(*start) : RenderResult{Film(film.crop_width, film.crop_height), {}, false};
  OCTOLUX_CHECK(result.film.width() == film.crop_width && result.film.height() == film.crop_height);
  Progress& progress = result.progress;
  const double seconds_before = progress.seconds;
  progress.total_passes = pass_limit(config);
  progress.caustic_paths = config.photons.caustic;
  if (progress.passes == 0) progress.direct_samples = first_direct_samples(config);
  result.interrupted = false;
  while (!result.interrupted && (progress.passes == 0 || !finished(config, progress))) {
    const PassKey key = job.key(progress.passes);
    const PixelPass pass = config.integrator == Integrator::photon
                               ? photon_mapping_pass(job, key, progress)
                               : path_tracing_pass(job, key, progress);
    add(pass, config, result);
    progress.pass_seconds = seconds_before + watch.seconds() - progress.seconds;
    progress.seconds += progress.pass_seconds;
    progress.rays_per_second = static_cast<double>(progress.rays) / progress.seconds;
    progress.remaining_seconds = remaining_seconds(config.stop, progress);
    result.interrupted = !observer.pass_done(progress, result.film);
  }
  return result;
}

}  // namespace octolux
