// The photons of a look-up eight at a time, as SIMD wants them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "accel/photon_map.h"
#include "estimators/simd8.h"

namespace octolux {

/// Eight neighbours. Lanes without one are infinitely far.
struct PhotonGroup {
  Float8 distance2;
  Mask8 photon;

  /// The fluxes of lanes 0 to 3 or 4 to 7 where `mask` is set; elsewhere 0.
  __attribute__((always_inline)) Long4 fluxes(const PhotonMap& map, int half, Mask8 mask) const {
    static_assert(sizeof(PhotonPayload) == 16 && offsetof(PhotonPayload, flux) == 0);
    const Mask8 words = 2 * photon;
    const Int4 index = half == 0 ? __builtin_shufflevector(words, words, 0, 1, 2, 3)
                                 : __builtin_shufflevector(words, words, 4, 5, 6, 7);
    const Mask8 wide = half == 0 ? __builtin_shufflevector(mask, mask, 0, 0, 1, 1, 2, 2, 3, 3)
                                 : __builtin_shufflevector(mask, mask, 4, 4, 5, 5, 6, 6, 7, 7);
    return gather4(map.payloads(), index) & reinterpret_as<Long4>(wide);
  }
};

/// Neighbours `first` to `first` + 7, as far as there are so many.
__attribute__((always_inline)) inline PhotonGroup photon_group(std::span<const Neighbour> photons,
                                                               std::size_t first) {
  static_assert(sizeof(Neighbour) == 8 && offsetof(Neighbour, photon) == 4);
  const Neighbour* from = &photons[first];
  Neighbour padded[8];
  if (first + 8 > photons.size()) {
    std::fill(std::copy(from, photons.data() + photons.size(), padded), padded + 8,
              Neighbour{kInfinity, from->photon});
    from = padded;
  }
  const Float8 low = load8(from), high = load8(from + 4);
  const Float8 photon = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
  return {__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14),
          reinterpret_as<Mask8>(photon)};
}

}  // namespace octolux
