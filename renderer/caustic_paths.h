// How many photon paths of a pass should look for caustics. Caustics that are much of the picture
// want many photons: their look-ups are seen directly, blur and all. Where there are hardly any,
// more photons only take time.
//
// With c paths for each of the global map, a pass takes time 1 + t c, and the picture's squared
// relative error is A + B m / c: m is the mean over the picture of (caustics / all light)^2, A is
// what other light brings, B what caustics would bring if there were nothing else. Error times time
// is least at c = sqrt(B m / (A t)), so c grows with the root of m, which a trial measures.
#pragma once

#include "renderer/config.h"
#include "renderer/learn_emission.h"

namespace octolux {

/// Caustic paths per pass: photons.caustic, or as told above if that is -1. `config` resolved.
/// Depends on scene, settings and seed alone, and on no setting of the kernel, so that renders by
/// different kernels have the same photons.
std::int64_t caustic_paths(const Scene& scene, const LightSampler& lights, const PhotonAim& aim,
                           const RenderConfig& config);

}  // namespace octolux
