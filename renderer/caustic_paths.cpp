// caustic_paths.h. The trial is a pass of few photons and few eye paths.
#include "renderer/caustic_paths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "renderer/eye_pass.h"
#include "renderer/glance.h"
#include "renderer/photon_pass.h"

namespace octolux {

namespace {

// Chosen by error at equal time, tools/bench/README.md.
constexpr double kPathsPerShare = 40;  // sqrt(B / (A t)) of caustic_paths.h
constexpr double kFewest = 0.25, kMost = 16;

constexpr std::int64_t kGlobalPaths = 1 << 15, kCausticPaths = 1 << 16;  // of the trial
constexpr std::int64_t kEyeRays = 1024;
constexpr std::uint64_t kPathsPerRay = 8;
constexpr std::int64_t kChunk = 16;  // eye rays

/// What the trial's maps are read with: the defaults, whatever the render's kernel.
RenderConfig trial_config(const RenderConfig& config) {
  RenderConfig trial;
  trial.seed = config.seed;
  trial.photons = config.photons;
  trial.eye.gather_rays = 4;
  trial.eye.light_samples = 2;
  trial.estimator.seen = true;
  return trial;
}

RadianceMap trial_map(const Scene& scene, const PhotonSource& source, PhotonKind kind,
                      const RenderConfig& config, const Estimator& estimator) {
  const std::int64_t paths = kind == PhotonKind::global ? kGlobalPaths : kCausticPaths;
  // Of a pass that no render comes to.
  PhotonMap map(
      trace_photons(scene, source, kind, paths, {config.seed, ~std::uint64_t{0}}).photons);
  const Bandwidth bandwidth = look_up_bandwidth(scene, config, kind, map.size(), 0);
  return RadianceMap(std::move(map), estimator, bandwidth);
}

/// (caustics / all light)^2 of what a random ray from the eye sees: of the mean of several paths,
/// as one that misses all other light would see a caustic alone.
double share2(const Scene& scene, const LightSampler& lights, const FinalGather& gather,
              std::uint64_t number, std::uint64_t seed) {
  Tracer tracer(scene, Rng(seed, Stream::trial, 0, number));
  const Ray ray = random_eye_ray(scene, tracer.rng);
  double caustic = 0, all = 0;
  for (std::uint64_t path = 0; path < kPathsPerRay; ++path) {
    tracer.sequence = {seed, number, path};
    const EyeSample sample = trace_eye_path(tracer, lights, gather, ray);
    caustic += mean(sample.caustic);
    all += mean(sample.radiance());
  }
  const double share = caustic / all;
  return std::isfinite(share) ? share * share : 0;
}

/// The mean of it over the picture.
double mean_share2(const Scene& scene, const LightSampler& lights, const FinalGather& gather,
                   std::uint64_t seed) {
  std::vector<double> shares(kEyeRays);
  parallel_for_chunks(kEyeRays, kChunk, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const auto number = static_cast<std::uint64_t>(i);
      shares[number] = share2(scene, lights, gather, number, seed);
    }
  });
  return std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(kEyeRays);
}

}  // namespace

std::int64_t caustic_paths(const Scene& scene, const LightSampler& lights, const PhotonAim& aim,
                           const RenderConfig& config) {
  if (config.photons.caustic >= 0) return config.photons.caustic;
  if (!scene.any_specular || lights.empty() || !config.eye.gather) return config.photons.global;
  const RenderConfig trial = trial_config(config);
  const std::unique_ptr<Estimator> estimator = make_estimator(trial.estimator);
  PhotonMaps maps;
  maps.caustics_mapped = true;
  maps.global =
      trial_map(scene, {lights, aim.global, false}, PhotonKind::global, trial, *estimator);
  maps.caustic = trial_map(scene, {lights, aim.caustic}, PhotonKind::caustic, trial, *estimator);
  const Learned nothing;
  const FinalGather gather(scene, lights, maps, nothing, trial);
  const double share = std::sqrt(mean_share2(scene, lights, gather, config.seed));
  const double paths = std::clamp(kPathsPerShare * share, kFewest, kMost);
  return static_cast<std::int64_t>(paths * static_cast<double>(config.photons.global));
}

}  // namespace octolux
