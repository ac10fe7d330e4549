// The reference: an unbiased path tracer (Kajiya 1986) with next-event estimation, multiple
// importance sampling and Russian roulette. It shares scene, camera and BSDFs with photon mapping
// and nothing of the photon code, so that where both agree, both are right.
#pragma once

#include "renderer/direct_light.h"
#include "renderer/film.h"

namespace octolux {

/// One path along `ray`. Fills direct (emission seen directly or through delta lobes, and light
/// sampled at the first other vertex) and indirect (the rest).
EyeSample trace_path(Tracer& tracer, const LightSampler& lights, Ray ray);

}  // namespace octolux
