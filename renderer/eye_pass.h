// Eye paths of photon mapping: specular chains are followed, and at every surface with smooth lobes
// the final gather is asked for what leaves it.
#pragma once

#include "renderer/film.h"
#include "renderer/final_gather.h"
#include "renderer/pixels.h"

namespace octolux {

/// One eye path along `ray`. What it gathers at the first Lambertian surface it meets is kept
/// `apart`, if that is asked for.
EyeSample trace_eye_path(Tracer& tracer, const LightSampler& lights, const FinalGather& gather,
                         Ray ray, Gathered* apart = nullptr);

/// The same for direct light and caustics alone: nothing is gathered, and indirect light left out.
EyeSample trace_direct_path(Tracer& tracer, const LightSampler& lights, const FinalGather& gather,
                            Ray ray);

}  // namespace octolux
