// Small steps that eye paths share: drawing a direction, and Russian roulette.
#pragma once

#include <optional>

#include "core/rng.h"
#include "core/scattering.h"

namespace octolux {

/// Eye paths scatter this often before roulette may end them.
inline constexpr int kSafeBounces = 4;

/// Draws lobe and direction.
inline std::optional<BsdfSample> sample_lobes(Rng& rng, const Scattering& at, Lobes lobes) {
  const float u_lobe = rng.uniform();
  const Vec2 u = rng.uniform2();
  return at.sample(u_lobe, u, lobes);
}

/// Russian roulette: a survivor's throughput is divided by its `chance`.
inline bool survives(Rng& rng, Rgb& beta, float chance) {
  if (!(rng.uniform() < chance)) return false;
  beta *= 1 / chance;
  return true;
}

/// The chance of a path with throughput `beta`. `eta` is the index ratio crossed so far: refraction
/// scales radiance, not what the path is worth.
inline float survival(Rgb beta, float eta = 1) {
  return std::min(0.95f, max_component(beta) * eta * eta);
}

}  // namespace octolux
