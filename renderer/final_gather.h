// Radiance leaving a point through its smooth lobes (DESIGN section 1): direct light by next-event
// estimation, caustics from their map, everything else gathered over rays that end in the global
// map. The map is read one bounce away, where its blur is averaged out; a gather ray that ends
// close by, where blur and leaks would show, or on a detail too small for a look-up, is not read
// but goes on one more bounce.
#pragma once

#include "estimators/radiance_map.h"
#include "renderer/config.h"
#include "renderer/direct_light.h"
#include "renderer/gather_directions.h"
#include "renderer/gather_records.h"
#include "renderer/learned_guides.h"
#include "renderer/learned_lights.h"

namespace octolux {

/// The maps of one pass.
struct PhotonMaps {
  RadianceMap global;
  RadianceMap caustic;
  GatherRecords records;         // of the global map; may be none
  bool caustics_mapped = false;  // is L S+ D read from the caustic map (or traced by gather rays)?
};

/// What is learned before the first pass.
struct Learned {
  LearnedGuides guides;
  LearnedLights lights;
};

/// Radiance split by path class.
struct SplitRadiance {
  Rgb direct, caustic, indirect;  // the last without `base`
  Rgb base;  // indirect light, too: all that is scattered where the eye path gathers, but for the
             // gloss of a coat over a diffuse base
  Rgb total() const { return direct + caustic + indirect + base; }
};

/// Thread-safe; refers to what it is given.
class FinalGather {
 public:
  FinalGather(const Scene& scene, const LightSampler& lights, const PhotonMaps& maps,
              const Learned& learned, const RenderConfig& config);

  /// Smooth-lobe radiance leaving `at`, which the eye path reached over `segments` segments, one of
  /// `paths` that its sample was split into.
  SplitRadiance radiance(Tracer& tracer, const Scattering& at, int segments, int paths = 1) const;
  /// Of it direct light and caustics alone, without a gather: of the same mean.
  SplitRadiance direct(Tracer& tracer, const Scattering& at, int segments, int paths = 1) const;

  /// Light samples at a point, for each of so many paths; none if nothing emits.
  LightSamples light_samples(int paths = 1) const;

 private:
  struct Level {
    int segments;         // from the eye to this point
    int rays;             // gather rays to send
    float read_distance;  // [m] shorter gather rays go on; of the first level not known yet
    int retraces;         // how often this path has gone on
    LightSamples light_samples;
  };
  SplitRadiance radiance(Tracer& tracer, const Scattering& at, const Level& level) const;
  SplitRadiance direct(Tracer& tracer, const Scattering& at, const Level& level,
                       const Receiver& lit, const GatherPoint& point) const;
  void gather(Tracer& tracer, const Scattering& at, const Level& level, const Receiver& lit,
              const GatherPoint& point, SplitRadiance& out) const;
  Receiver learned_receiver(const Scattering& at) const;
  Level first_level(int segments, int paths) const;
  Rgb follow(Tracer& tracer, Ray ray, const Level& level, Arrival arrival) const;
  Rgb scattered(Tracer& tracer, const Scattering& at, const Level& here, float distance) const;
  Rgb narrow_direct(Tracer& tracer, const Scattering& at, const Level& here) const;
  GatherDirections::Points gather_points(Tracer& tracer, const Level& level, int guided) const;
  LightPoints light_points(Tracer& tracer, const Level& level, LightSamples n) const;
  GatherPoint gather_point(Tracer& tracer, const Scattering& at, int segments) const;
  float read_distance(const GatherPoint& at) const;
  int remaining(int segments) const;

  const Scene& scene_;
  const LightSampler& lights_;
  const PhotonMaps& maps_;
  const Learned& learned_;
  const RenderConfig& config_;
  LightSamples light_samples_;
};

}  // namespace octolux
