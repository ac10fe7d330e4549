// Light that comes straight from a light source: next-event estimation and BSDF sampling, combined
// by the power heuristic (Veach 1997, 9.2).
#pragma once

#include "renderer/light_sampler.h"
#include "renderer/tracer.h"

namespace octolux {

/// The two techniques that share the direct light at a point, and how often each is used there.
struct DirectStrategy {
  Lobes lobes = Lobes::non_delta;  // whose light next-event estimation brings
  Lobes sampled = Lobes::all;      // the set BSDF sampling draws from
  LightSamples light_samples;
  int bsdf_samples = 1;
  int max_crossings = 0;  // panes and masks a connection may cross; negative: no light
};

/// What the choice of a light may know about `at`: its side, unless its lobes transmit. Light from
/// the other side of the shading normal scatters nothing (core/scattering.h).
Receiver receiver(const Scattering& at);

/// What light samples are drawn with: of n, sample i chooses its light at (i + choice) / n of all,
/// and its place there by places[i] or narrow[i].
struct LightPoints {
  LightPoints(LightSamples n, Rng& rng);
  LightPoints(PointSet places_, PointSet choices, PointSet narrow_)
      : places(places_), narrow(narrow_), choice(choices[0].x) {}

  PointSet places, narrow;
  float choice;
};

/// Next-event estimation at `at`: radiance towards at.wo(), the share of it that the heuristic
/// gives this technique. `lit` is receiver(at). `points`: for so many light samples.
Rgb sample_lights(Tracer& tracer, const LightSampler& lights, const Scattering& at,
                  const Receiver& lit, const DirectStrategy& strategy, const LightPoints& points);

/// What one choice of a light brings, with `u` for the place on it, before dividing by the number
/// of samples: its mean is that of sample_lights, for the kind of light chosen from.
Rgb sample_light(Tracer& tracer, const LightSampler::Choice& choice, Vec2 u, const Scattering& at,
                 const DirectStrategy& strategy);

/// How a path arrived where it is, as far as the heuristic must know.
struct Arrival {
  Receiver from;    // the point that scattered last
  float pdf_w = 0;  // [sr^-1] of the scattered direction
  int bsdf_samples = 1;
  LightSamples light_samples;  // none: no next-event estimation there; this technique has all
};

/// Radiance that `hit` emits back along the path, the share of it that BSDF sampling has.
Rgb emitted(const LightSampler& lights, const SurfaceHit& hit, Vec3 wo, const Arrival& arrival);

/// The same for the environment in direction `wi`.
Rgb environment(const Scene& scene, const LightSampler& lights, Vec3 wi, const Arrival& arrival);

}  // namespace octolux
