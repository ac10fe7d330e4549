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

/// Russian roulette on a path's throughput; the survivor's is divided by its chance. `eta` is the
/// index ratio crossed so far: refraction scales radiance, not what the path is worth.
inline bool survives(Rng& rng, Rgb& beta, float eta) {
  const float survival = std::min(0.95f, max_component(beta) * eta * eta);
  if (!(rng.uniform() < survival)) return false;
  beta *= 1 / survival;
  return true;
}

}  // namespace octolux
