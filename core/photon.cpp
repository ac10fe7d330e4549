// Packing photons; unpacking is in the header. Flux as in Ward's shared exponent ("Real Pixels",
// Graphics Gems II, 1991) with wider mantissas and rounding to nearest, directions octahedral
// (Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2),
// 2014). Pure functions.
#include "core/photon.h"

#include <algorithm>

namespace octolux {
namespace {

constexpr std::uint64_t kMantissaEnd = 1u << kFluxBits;

/// As std::frexp's, of a positive number; every float is a normal double.
int exponent_of(float x) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(static_cast<double>(x)) >> 52) - 1022;
}

std::uint64_t mantissa(float channel, int exponent) {
  const auto scale =
      std::bit_cast<double>(static_cast<std::uint64_t>(kFluxBits - exponent + 1023) << 52);
  return static_cast<std::uint64_t>(std::nearbyint(channel * scale));
}

std::uint32_t to_grid(float x, int bits) {
  const auto middle = static_cast<float>((1u << (bits - 1)) - 1);
  return static_cast<std::uint32_t>(std::nearbyint(x * middle + middle));
}

}  // namespace

std::uint64_t pack_flux(Rgb flux) {
  const float largest = max_component(flux);
  if (!(largest > 0)) return 0;
  int exponent = exponent_of(largest);
  if (mantissa(largest, exponent) == kMantissaEnd && exponent < 128) ++exponent;
  const auto channel = [&](float c) { return std::min(mantissa(c, exponent), kMantissaEnd - 1); };
  return channel(flux.r) | channel(flux.g) << kFluxBits | channel(flux.b) << (2 * kFluxBits) |
         static_cast<std::uint64_t>(exponent + kFluxExponentBias) << (3 * kFluxBits);
}

std::uint32_t pack_direction(Vec3 unit, int bits) {
  const Vec3 size = abs(unit);
  const float sum = size.x + size.y + size.z;
  if (!(sum > 0)) return pack_direction({0, 0, 1}, bits);
  float x = unit.x / sum;
  float y = unit.y / sum;
  if (unit.z < 0) {
    const float folded_x = std::copysign(1 - std::abs(y), x);
    y = std::copysign(1 - std::abs(x), y);
    x = folded_x;
  }
  return to_grid(x, bits) | to_grid(y, bits) << bits;
}

PhotonPayload pack(const Photon& photon) {
  PhotonPayload payload;
  payload.flux = pack_flux(photon.flux);
  payload.wi = pack_direction(photon.wi, kWiBits);
  payload.normal_segments =
      pack_direction(photon.normal, kNormalBits) << 8 |
      static_cast<std::uint32_t>(std::clamp(photon.segments, 1, kMaxSegments));
  return payload;
}

}  // namespace octolux
