// Light paths: photons leave the lights, scatter, and are stored where they meet smooth lobes.
// One walk serves both maps; they differ in what they follow and keep (Heckbert's notation):
//   global   L (S|D)* D   follows every lobe, keeps a photon at every D
//   caustic  L S+ D       follows specular lobes only, keeps a photon where such a chain ends
// How far records of irradiance serve is told by global photons of other paths, and guides are
// learned from global photons of others still.
#pragma once

#include <cstdint>

#include "estimators/radiance_map.h"
#include "renderer/config.h"
#include "renderer/emission_density.h"
#include "renderer/light_sampler.h"
#include "renderer/tracer.h"

namespace octolux {

enum class PhotonKind { global, caustic, record, guide };

/// What one photon pass did.
struct PhotonPass {
  std::vector<Photon> photons;
  std::int64_t rays = 0;
};

/// What makes a pass repeatable: its photons are those of (seed, pass, photon index), on any number
/// of threads.
struct PassKey {
  std::uint64_t seed = 1;
  std::uint64_t pass = 0;
};

/// Where photons come from: the lights, and how likely each of their photons is.
struct PhotonSource {
  const LightSampler& lights;
  const EmissionDensity& density;
  bool all = true;  // also what gather rays sample where they end: narrow lights' direct light?
};

/// Emits `count` paths [flux already divided by it].
PhotonPass trace_photons(const Scene& scene, const PhotonSource& source, PhotonKind kind,
                         std::int64_t count, PassKey key);
/// The same by power alone.
PhotonPass trace_photons(const Scene& scene, const LightSampler& lights, PhotonKind kind,
                         std::int64_t count, PassKey key);

/// The photon that starts at `at`, as one of `count` emitted by power.
EmittedPhoton emit_photon(const LightSampler& lights, const EmissionPoint& at, float count);
/// Follows it, and appends what is stored on its way: of a narrow light, not where it arrives
/// straight from there.
void trace_photon(Tracer& tracer, const EmittedPhoton& start, PhotonKind kind,
                  std::vector<Photon>& photons);

/// Bandwidth of the look-ups in a map of `photons` photons: a limit of photons.global_radius or
/// caustic_radius times the mean radius of a look-up's photons on the scene's surfaces, and the
/// pass's shrink factor s with s_1 = 1, s^2_{k+1} / s^2_k = (k + alpha) / (k + 1) (Knaus & Zwicker
/// 2011, eq. 10).
Bandwidth look_up_bandwidth(const Scene& scene, const RenderConfig& config, PhotonKind kind,
                            std::size_t photons, std::uint64_t pass);

}  // namespace octolux
