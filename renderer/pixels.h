// From one path to the picture of one pass: which samples are taken, and what each pixel makes of
// them. Nothing depends on threads.
#pragma once

#include <cstdint>
#include <functional>

#include "renderer/config.h"
#include "renderer/film.h"
#include "renderer/gather_sharing.h"
#include "renderer/photon_pass.h"
#include "renderer/tracer.h"

namespace octolux {

/// How to follow one camera ray: `full` has all radiance, but for what is kept `apart`, which may
/// be nullptr; `direct`, which may be missing if none is asked for, direct light and caustics
/// alone.
struct EyePaths {
  std::function<EyeSample(Tracer& tracer, const Ray& ray, Gathered* apart)> full;
  std::function<EyeSample(Tracer& tracer, const Ray& ray)> direct = {};
};

/// What a pass takes of each pixel.
struct SamplePlan {
  int full = 1;                    // eye samples
  std::int64_t direct = 0;         // for each of them so many more, of direct light and caustics
  std::int64_t direct_before = 0;  // of those, taken by earlier passes
};

/// The picture of one pass, what it took, and what went wrong.
struct PixelPass {
  PassImage image;
  std::int64_t rays = 0;
  std::int64_t non_finite = 0;       // samples left out because they were not finite
  std::size_t first_non_finite = 0;  // pixel (y * width + x) of the first of them
};

/// Traces eye paths as planned for every pixel of the scene's film; every pixel is the mean of
/// those that its filter reaches. Pixels share what they gather, within `shrink` times their reach.
PixelPass trace_pixels(const Scene& scene, const SamplePlan& plan, PassKey key,
                       const EyePaths& paths, const GatherSharing& sharing = {}, float shrink = 1);

/// Albedo, normal and depth of the first surface an eye path met along `ray`.
void describe_first_hit(EyeSample& out, const Scene& scene, const SurfaceHit& hit, const Ray& ray);

}  // namespace octolux
