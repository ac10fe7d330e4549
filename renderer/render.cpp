// render.h: the main path of the program. A pass of photon mapping is photons, maps, eye paths; a
// pass of path tracing is eye paths alone.
#include "renderer/render.h"

#include <chrono>

#include "core/check.h"
#include "renderer/eye_pass.h"
#include "renderer/learn_emission.h"
#include "renderer/path_pass.h"

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

/// What all passes of a render share.
struct Job {
  Job(const Scene& scene_, const RenderConfig& config_)
      : scene(scene_),
        config(config_),
        lights(scene),
        estimator(make_estimator(config.estimator)) {}

  const Scene& scene;
  const RenderConfig& config;
  const LightSampler lights;
  const std::unique_ptr<Estimator> estimator;
  PhotonAim aim;

  PassKey key(int pass) const { return {config.seed, static_cast<std::uint64_t>(pass)}; }
};

/// Photons of one kind in their map.
RadianceMap make_map(const Job& job, PhotonKind kind, PassKey key, Progress& progress) {
  const PhotonConfig& photons = job.config.photons;
  const bool global = kind == PhotonKind::global;
  Stopwatch watch;
  const PhotonSource source{job.lights, global ? job.aim.global : job.aim.caustic};
  PhotonPass traced =
      trace_photons(job.scene, source, kind, global ? photons.global : photons.caustic, key);
  progress.rays += traced.rays;
  progress.timing.photons += watch.lap();

  PhotonMap map(std::move(traced.photons));
  (global ? progress.global_photons : progress.caustic_photons) =
      static_cast<std::int64_t>(map.size());
  progress.rejected_photons += static_cast<std::int64_t>(map.rejected());
  progress.photon_bytes += static_cast<std::int64_t>(map.memory());
  const Bandwidth bandwidth = look_up_bandwidth(
      job.scene, map.size(), job.config.estimator.neighbours,
      global ? photons.global_radius : photons.caustic_radius, photons.alpha, key.pass);
  progress.timing.maps += watch.lap();
  return RadianceMap(std::move(map), *job.estimator, bandwidth);
}

/// Photon paths that make sites of records: as many as put about one site into the reach of each.
std::int64_t record_paths(const RenderConfig& config, const Bandwidth& bandwidth) {
  constexpr double kShare = 0.2;  // of the photons, where the bandwidth is not yet shrunk
  const double share = std::min(1.0, kShare / (bandwidth.shrink * bandwidth.shrink));
  return static_cast<std::int64_t>(share * static_cast<double>(config.photons.global));
}

/// Records of what gather rays will find in `map`.
GatherRecords make_records(const Job& job, const RadianceMap& map, PassKey key,
                           Progress& progress) {
  const RenderConfig& config = job.config;
  if (!config.eye.gather || !(config.eye.reuse > 0)) return {};
  Stopwatch watch;
  const PhotonPass traced =
      trace_photons(job.scene, {job.lights, job.aim.global}, PhotonKind::record,
                    record_paths(config, map.bandwidth()), key);
  progress.rays += traced.rays;
  progress.timing.photons += watch.lap();
  RecordConfig records;
  records.neighbours = config.estimator.neighbours;
  if (job.scene.max_depth >= 0) records.max_segments = std::clamp(job.scene.max_depth - 2, 0, 255);
  records.must_see = job.estimator->sees_geometry();
  records.turn_key = hash64(hash64(key.seed) ^ key.pass);
  GatherRecords made(
      RecordSites(traced.photons, map.bandwidth(), records.neighbours, config.eye.reuse), map,
      *job.scene.caster, records);
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
  const FinalGather gather(job.scene, job.lights, maps, job.config);
  PixelPass pixels = trace_pixels(job.scene, job.config.eye.samples_per_pass, key,
                                  [&](Tracer& tracer, const Ray& ray) {
                                    return trace_eye_path(tracer, job.lights, gather, ray);
                                  });
  progress.rays += pixels.rays;
  progress.timing.eye += watch.lap();
  return pixels;
}

PixelPass path_tracing_pass(const Job& job, PassKey key, Progress& progress) {
  Stopwatch watch;
  PixelPass pixels = trace_pixels(
      job.scene, job.config.eye.samples_per_pass, key,
      [&](Tracer& tracer, const Ray& ray) { return trace_path(tracer, job.lights, ray); });
  progress.rays += pixels.rays;
  progress.timing.eye += watch.lap();
  return pixels;
}

/// Passes allowed by the rules that count them; 0: no such rule.
int pass_limit(const StopConfig& stop, int samples_per_pass) {
  const int by_samples = (stop.samples + samples_per_pass - 1) / samples_per_pass;
  if (stop.passes == 0 || by_samples == 0) return std::max(stop.passes, by_samples);
  return std::min(stop.passes, by_samples);
}

bool has_rule(const StopConfig& stop) {
  return stop.passes > 0 || stop.samples > 0 || stop.seconds > 0 || stop.error > 0;
}

/// The error is only trusted once this many passes have had their say.
constexpr int kPassesForError = 4;

/// Time still needed by the rule that will be reached first, as far as can be foreseen.
double remaining_seconds(const StopConfig& stop, const Progress& p) {
  const double per_pass = p.seconds / p.passes;
  double left = kInfinity;
  if (p.total_passes > 0) left = std::min(left, per_pass * (p.total_passes - p.passes));
  if (stop.seconds > 0) left = std::min(left, stop.seconds - p.seconds);
  if (stop.error > 0 && p.passes >= kPassesForError) {
    const double ratio = p.error / stop.error;
    left = std::min(left, p.seconds * (ratio * ratio - 1));
  }
  return left < kInfinity ? std::max(0.0, left) : -1;
}

}  // namespace

bool finished(const RenderConfig& config, const Progress& p) {
  const StopConfig& stop = config.stop;
  const int limit = pass_limit(stop, config.eye.samples_per_pass);
  if (limit > 0 && p.passes >= limit) return true;
  if (stop.seconds > 0 && p.seconds + 0.5 * p.seconds / p.passes >= stop.seconds) return true;
  return stop.error > 0 && p.passes >= kPassesForError && p.error <= stop.error;
}

StopConfig default_stop(Integrator integrator) {
  StopConfig stop;
  stop.passes = integrator == Integrator::photon ? 256 : 1024;
  stop.error = 0.02;
  return stop;
}

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
  }
  RenderResult result =
      start ? std::move(*start) : RenderResult{Film(film.crop_width, film.crop_height), {}, false};
  OCTOLUX_CHECK(result.film.width() == film.crop_width && result.film.height() == film.crop_height);
  Progress& progress = result.progress;
  const double seconds_before = progress.seconds;
  progress.total_passes = pass_limit(config.stop, config.eye.samples_per_pass);
  result.interrupted = false;
  while (!result.interrupted && (progress.passes == 0 || !finished(config, progress))) {
    const PassKey key = job.key(progress.passes);
    const PixelPass pass = config.integrator == Integrator::photon
                               ? photon_mapping_pass(job, key, progress)
                               : path_tracing_pass(job, key, progress);
    result.film.note_non_finite(pass.non_finite, pass.first_non_finite);
    result.film.add(pass.image);
    ++progress.passes;
    progress.pass_seconds = seconds_before + watch.seconds() - progress.seconds;
    progress.seconds += progress.pass_seconds;
    progress.error = result.film.relative_error();
    progress.rays_per_second = static_cast<double>(progress.rays) / progress.seconds;
    progress.remaining_seconds = remaining_seconds(config.stop, progress);
    result.interrupted = !observer.pass_done(progress, result.film);
  }
  return result;
}

}  // namespace octolux
