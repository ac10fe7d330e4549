// Sums of packed fluxes, four at a time and without branches: a mantissa becomes a double by way of
// its bits, and its exponent a power of two. In double, so a sum of floats loses nothing.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/photon.h"
#include "estimators/simd8.h"

namespace octolux {

class FluxSum {
 public:
  /// Four packed fluxes; a flux of 0 bits adds nothing.
  __attribute__((always_inline)) void add(Long4 packed) {
    constexpr std::int64_t kExponent = 1023 - kFluxExponentBias - kFluxBits;
    const auto scale = reinterpret_as<Double4>(((packed >> (3 * kFluxBits)) + kExponent) << 52);
    red_ += channel(packed, 0) * scale;
    green_ += channel(packed, 1) * scale;
    blue_ += channel(packed, 2) * scale;
  }

  Rgb total() const { return {sum(red_), sum(green_), sum(blue_)}; }

 private:
  __attribute__((always_inline)) static Double4 channel(Long4 packed, int i) {
    constexpr std::int64_t kMantissa = (1 << kFluxBits) - 1;
    constexpr std::int64_t kTwo52 = 0x4330000000000000;  // the bits of 2^52, whose last is 1
    const Long4 mantissa = (packed >> (i * kFluxBits)) & kMantissa;
    return reinterpret_as<Double4>(mantissa | kTwo52) - 0x1p52;
  }
  static float sum(Double4 v) { return static_cast<float>((v[0] + v[1]) + (v[2] + v[3])); }

  Double4 red_{}, green_{}, blue_{};
};

}  // namespace octolux
