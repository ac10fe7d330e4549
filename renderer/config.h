// Every setting of a render: declared once here with default and unit, listed once in visit(),
// which serves `--set`, and the provenance written into the EXR.
#pragma once

#include <cstdint>

#include "estimators/estimator.h"

namespace octolux {

enum class Integrator { photon, path };

struct PhotonConfig {
  std::int64_t global =
      -1;  // paths per pass for the global map; -1: half the pixels, at least 50 000
  std::int64_t caustic = -1;  // the same for the caustic map; 0: none, gather rays find caustics;
                              // -1: as caustics are worth it (caustic_paths.h)
  double global_radius = 10;  // look-up limit, in units of the mean n-photon radius
  double caustic_radius = 2;  // the same for the caustic map
  double alpha = 2.0 / 3;     // Knaus & Zwicker's: how fast the bandwidth shrinks; 1: never
  bool learn = true;          // aim photons at what gather rays will read, where that pays
};

struct EyeConfig {
  bool gather = true;         // false: show the global map directly
  int gather_rays = 8;        // per eye sample
  int light_samples = 4;      // per eye sample; each chooses one light
  int samples_per_pass = -1;  // eye samples per pixel and pass; -1: see resolved()
  int direct_samples = -1;    // further ones for each, of direct light and caustics alone; -1: as
                              // noise asks (direct_samples.h)
  double retrace = 2;         // gather rays shorter than this many bandwidths go on
  bool learn = true;          // learn before the first pass where light comes from and is seen
  bool seen = true;           // gathered look-ups count only photons that they see (seen_photons.h)
  double reuse = 0.9;         // how far gather rays share irradiance (record_sites.h); 0: never
  double share = 0.15;        // how far pixels share gathers (gather_sharing.h); 0: not at all
};

/// The first that is reached stops the render, at the end of a pass. 0: not set.
struct StopConfig {
  int passes = 0;
  int samples = 0;  // eye samples per pixel
  double seconds = 0;
  double error = 0;  // mean over pixels of the relative standard error
};

struct RenderConfig {
  Integrator integrator = Integrator::photon;
  std::uint64_t seed = 1;
  PhotonConfig photons;
  EstimatorConfig estimator;
  EyeConfig eye;
  StopConfig stop;
};

/// Calls field("photons.global", config.photons.global) and so on for every setting that has a
/// plain value; works for const and non-const configs.
template <class Config, class Field>
void visit(Config& config, Field&& field) {
  field("seed", config.seed);
  field("photons.global", config.photons.global);
  field("photons.caustic", config.photons.caustic);
  field("photons.global_radius", config.photons.global_radius);
  field("photons.caustic_radius", config.photons.caustic_radius);
  field("photons.alpha", config.photons.alpha);
  field("photons.learn", config.photons.learn);
  field("estimator.kernel", config.estimator.kernel);
  field("estimator.neighbours", config.estimator.neighbours);
  field("estimator.cone_slope", config.estimator.cone_slope);
  field("estimator.octants", config.estimator.octants);
  field("estimator.correction", config.estimator.correction);
  field("estimator.feelers", config.estimator.feelers);
  field("eye.gather", config.eye.gather);
  field("eye.gather_rays", config.eye.gather_rays);
  field("eye.light_samples", config.eye.light_samples);
  field("eye.samples_per_pass", config.eye.samples_per_pass);
  field("eye.direct_samples", config.eye.direct_samples);
  field("eye.retrace", config.eye.retrace);
  field("eye.learn", config.eye.learn);
  field("eye.seen", config.eye.seen);
  field("eye.reuse", config.eye.reuse);
  field("eye.share", config.eye.share);
  field("stop.passes", config.stop.passes);
  field("stop.samples", config.stop.samples);
  field("stop.seconds", config.stop.seconds);
  field("stop.error", config.stop.error);
}

/// The config with every automatic value (-1) replaced by what it stands for on a film of `pixels`,
/// but for photons.caustic and eye.direct_samples, which depend on the scene.
/// A pass of photon mapping takes up to 4 eye samples per pixel, so that there are about three for
/// every photon path: on a small film the photons would else take most of the time. The number
/// divides stop.samples, so that exactly those are taken.
RenderConfig resolved(RenderConfig config, std::int64_t pixels);

/// Throws Error if a value is out of its range.
void check(const RenderConfig& config);

}  // namespace octolux
