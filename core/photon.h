// A photon where it lands, and its packed form (28 bytes in the map: position apart, 16 here).
#pragma once

#include <cstdint>

#include "core/rgb.h"
#include "core/vec.h"

namespace octolux {

struct Photon {
  Vec3 position;     // [m]
  Vec3 wi;           // unit, towards where it came from
  Vec3 normal;       // geometric normal on the side it arrived from: dot(normal, wi) > 0
  Rgb flux;          // [W], already divided by the number of emitted paths
  int segments = 1;  // path segments from the light to here, 1 to 255
};

/// Everything but the position. flux: three 18-bit mantissas with a shared exponent (relative
/// precision 4e-6 of the largest channel, exact under powers of two). wi: octahedral 2 x 16 bits
/// (Cigolle et al., JCGT 3(2), 2014); normal: octahedral 2 x 12 bits; segments: 8 bits.
struct PhotonPayload {
  std::uint64_t flux = 0;
  std::uint32_t wi = 0;
  std::uint32_t normal_segments = 0;
};
static_assert(sizeof(PhotonPayload) == 16);

std::uint64_t pack_flux(Rgb flux);
Rgb unpack_flux(std::uint64_t packed);
std::uint32_t pack_direction(Vec3 unit, int bits);      // 2 * bits bits used
Vec3 unpack_direction(std::uint32_t packed, int bits);  // unit

PhotonPayload pack(const Photon& photon);
inline int segments(const PhotonPayload& p) { return static_cast<int>(p.normal_segments & 0xff); }
Vec3 normal(const PhotonPayload& p);
Vec3 wi(const PhotonPayload& p);

}  // namespace octolux
