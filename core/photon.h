// A photon where it lands, and its packed form (28 bytes in the map: position apart, 16 here).
// Unpacking is inline, because every look-up does it for every neighbour. Pure functions.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/rgb.h"
#include "core/vec.h"

namespace octolux {

inline constexpr int kMaxSegments = 255;  // told apart; longer paths count as so long

struct Photon {
  Vec3 position;     // [m]
  Vec3 wi;           // unit, towards where it came from
  Vec3 normal;       // geometric normal on the side it arrived from: dot(normal, wi) > 0
  Rgb flux;          // [W], already divided by the number of emitted paths
  int segments = 1;  // path segments from the light to here, 1 to kMaxSegments
  float error = 0;   // [m] bound on the error of the position; not kept in maps
  Vec3 ns{};         // shading normal on the side of `normal`; not kept in maps
  float flown = 0;   // [m] since a smooth lobe scattered it last, 0 if none has; not in maps
};

/// By a smooth lobe? If not, it is direct light or a caustic.
inline bool scattered(const Photon& p) { return p.flown > 0; }

/// Finite, and of no negative flux?
inline bool is_usable(const Photon& p) {
  return is_finite(p.position) && is_finite(p.wi) && is_finite(p.normal) && is_finite(p.flux) &&
         p.flux.r >= 0 && p.flux.g >= 0 && p.flux.b >= 0;
}

/// Everything but the position. flux: three 18-bit mantissas with a shared exponent (relative
/// precision 4e-6 of the largest channel, exact under powers of two). wi: octahedral 2 x 16 bits
/// (Cigolle et al., JCGT 3(2), 2014); normal: octahedral 2 x 12 bits; segments: 8
/// bits.
struct PhotonPayload {
  std::uint64_t flux = 0;
  std::uint32_t wi = 0;
  std::uint32_t normal_segments = 0;
};
static_assert(sizeof(PhotonPayload) == 16);

inline constexpr int kFluxBits = 18;           // per channel; the exponent takes the 10 bits above
inline constexpr int kFluxExponentBias = 149;  // std::frexp gives -148 for the smallest float
inline constexpr int kWiBits = 16;
inline constexpr int kNormalBits = 12;

/// `flux` finite and not negative. A flux that would round up to infinity is rounded down.
std::uint64_t pack_flux(Rgb flux);

inline Rgb unpack_flux(std::uint64_t packed) {
  constexpr std::uint64_t mask = (1u << kFluxBits) - 1;
  const auto exponent = static_cast<std::int64_t>(packed >> (3 * kFluxBits)) - kFluxExponentBias;
  const auto scale =
      std::bit_cast<double>(static_cast<std::uint64_t>(exponent - kFluxBits + 1023) << 52);
  const auto channel = [&](int i) {
    const auto mantissa = static_cast<std::int32_t>((packed >> (i * kFluxBits)) & mask);
    return static_cast<float>(mantissa * scale);
  };
  return {channel(0), channel(1), channel(2)};
}

/// 2 * bits bits. The grid has a line through the axes, so the directions +-x, +-y, +-z are exact.
std::uint32_t pack_direction(Vec3 unit, int bits);

/// The packed direction scaled to |x| + |y| + |z| = 1: enough where only its side matters.
inline Vec3 unpack_octahedral(std::uint32_t packed, int bits) {
  const std::uint32_t mask = (1u << bits) - 1;
  const auto middle = static_cast<float>((1u << (bits - 1)) - 1);
  const float scale = 1 / middle;
  const float x = (static_cast<float>(packed & mask) - middle) * scale;
  const float y = (static_cast<float>((packed >> bits) & mask) - middle) * scale;
  const float z = 1 - std::abs(x) - std::abs(y);
  const float fold = std::max(-z, 0.0f);  // the lower half is folded over the diamond's edges
  return {x - std::copysign(fold, x), y - std::copysign(fold, y), z};
}

inline Vec3 unpack_direction(std::uint32_t packed, int bits) {  // unit
  return normalize(unpack_octahedral(packed, bits));
}

PhotonPayload pack(const Photon& photon);
inline int segments(const PhotonPayload& p) {
  return static_cast<int>(p.normal_segments & kMaxSegments);
}
inline Vec3 normal(const PhotonPayload& p) {
  return unpack_direction(p.normal_segments >> 8, kNormalBits);
}
inline Vec3 wi(const PhotonPayload& p) { return unpack_direction(p.wi, kWiBits); }

}  // namespace octolux
