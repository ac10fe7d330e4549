// From one path to the picture of one pass: which samples a pixel takes, in tiles that do not
// depend on threads.
#pragma once

#include <cstdint>
#include <functional>

#include "renderer/config.h"
#include "renderer/film.h"
#include "renderer/photon_pass.h"
#include "renderer/tracer.h"

namespace octolux {

/// Radiance and layers along one camera ray.
using EyePathFunction = std::function<EyeSample(Tracer& tracer, const Ray& ray)>;

/// The picture of one pass, and the rays it took.
struct PixelPass {
  PassImage image;
  std::int64_t rays = 0;
};

/// Traces `samples` eye paths for every pixel of the scene's film and averages them.
PixelPass trace_pixels(const Scene& scene, int samples, PassKey key, const EyePathFunction& path);

/// Albedo, normal and depth of the first surface an eye path met along `ray`.
void describe_first_hit(EyeSample& out, const Scene& scene, const SurfaceHit& hit, const Ray& ray);

}  // namespace octolux
