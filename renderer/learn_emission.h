// Learns, before the first pass of a render, which photons are of use to the picture: those that
// are stored where the eye will read them. Rounds of trial photons, each emitted by what the rounds
// before have learned, are scored by the cells of eye_cells.h they land in:
//
//   use = sum over the path's photons of v g^2 / (mu^2 + m^2)
//
// v: look-ups in the photon's cell; g: its share of the lights' power; mu: the cell's mean of g per
// path; m: the median cell's mu. This is the path's part in the mean over all look-ups of the
// relative variance of what they read (relative to the median where it is darker than that), so
// EmissionDensity is the density with which that variance is least. A dim room thus gets the
// photons it needs beside a bright terrace, and one lamp near the eye beside a thousand far away.
//
// What is learned depends on scene, settings and seed alone: all passes of a render share it, they
// stay independent, and a render that goes on from a checkpoint learns the same again.
#pragma once

#include "renderer/config.h"
#include "renderer/emission_density.h"
#include "renderer/photon_pass.h"

namespace octolux {

/// What there is to gain must exceed this, or photons leave by power alone: learned photons are
/// less even, and scatter more.
inline constexpr double kWorthwhileGain = 1.5;

/// Densities for the photons of both maps; uniform where learning is off or would bring too little,
/// and without final gathering: who looks at the map itself sees photons as the lights emit them.
struct PhotonAim {
  EmissionDensity global, caustic;
};

/// `config` resolved.
PhotonAim learn_emission(const Scene& scene, const LightSampler& lights,
                         const RenderConfig& config);

}  // namespace octolux
