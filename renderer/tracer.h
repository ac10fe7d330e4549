// One path's way through the scene: rays from surface to surface, straight through whatever lets
// light pass (masks, thin panes), and how much light arrives from a point of a light. Every path,
// eye or photon, owns one, with its own random numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/light.h"
#include "core/point_set.h"
#include "core/rng.h"
#include "core/scattering.h"
#include "renderer/scene.h"

namespace octolux {

/// A surface that a path scatters at.
struct SurfaceHit {
  SurfacePoint point;
  const Bsdf* bsdf = nullptr;
  const AreaLight* light = nullptr;  // nullptr if the surface does not emit
  float distance = 0;                // [m] from the ray's origin, straight transmissions included
};

class Tracer {
 public:
  Tracer(const Scene& scene, Rng rng_) : rng(rng_), scene_(scene) {}

  /// The next surface along `ray` (unit direction) that scatters. Where light may pass straight on,
  /// chance decides whether it does, and `weight` is divided by the probability. `segments` grows
  /// by one for every surface met, and by one if the ray escapes.
  std::optional<SurfaceHit> next(Ray ray, Rgb& weight, int& segments);

  /// Share of light that reaches `from` along `light`: 0 if blocked, below 1 through panes and
  /// masks, of which it may cross at most `max_crossings`.
  Rgb visibility(const SurfacePoint& from, const LightSample& light, int max_crossings);

  /// A ray as it was cast, for benchmarks that cast the same rays again.
  struct LoggedRay {
    Ray ray;
    bool shadow = false;
  };
  /// Where every ray is written, if set.
  std::vector<LoggedRay>* log = nullptr;

  const Scene& scene() const { return scene_; }
  std::int64_t rays() const { return rays_; }

  Rng rng;
  PixelSequence sequence;  // of eye paths

 private:
  void count(const Ray& ray, bool shadow) {
    ++rays_;
    if (log) log->push_back({ray, shadow});
  }

  const Scene& scene_;
  std::int64_t rays_ = 0;
};

}  // namespace octolux
