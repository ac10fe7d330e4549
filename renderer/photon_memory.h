// What the photons of a pass will take, known before the first pass: a machine that runs out of
// memory ends the program in the middle of long work, and says nothing.
#pragma once

#include <cstdint>

#include "accel/photon_map.h"
#include "renderer/config.h"
#include "renderer/learn_emission.h"

namespace octolux {

/// Of a photon while its map is made: as traced, packed, and as the tree sorts it.
inline constexpr double kBytesToMap =
    sizeof(Photon) + sizeof(PhotonTree::Item) + sizeof(PhotonPayload) + sizeof(FacingSet);

struct PhotonMemory {
  double photons = 0;  // stored in a pass, in both maps
  double bytes = 0;    // held at once by photons, maps and records, in the last pass at the most
};

/// Judged by the photons of a few trial paths, so right within some percent. `config` resolved.
PhotonMemory foresee_photons(const Scene& scene, const LightSampler& lights, const PhotonAim& aim,
                             const RenderConfig& config);

/// Throws Error if a pass's photons are too many for a map, or their bytes for `memory` [bytes];
/// `config` resolved.
void check_photons(const PhotonMemory& needed, const RenderConfig& config, double memory);

/// What the machine, or the control group the program runs in, has in all [bytes].
double physical_memory();

}  // namespace octolux
