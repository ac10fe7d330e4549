// Sums of packed fluxes without unpacking each: mantissas of one exponent are added as integers, so
// a run of photons of like power costs a few instructions each and is summed exactly.
#pragma once

#include <bit>
#include <cstdint>

#include "core/photon.h"

namespace octolux {

class FluxSum {
 public:
  void add(std::uint64_t packed) {
    const auto exponent = static_cast<std::uint32_t>(packed >> (3 * kFluxBits));
    if (exponent != exponent_ || room_ == 0) flush(exponent);
    red_blue_ += packed & kRedBlue;
    green_ += (packed >> kFluxBits) & kMantissa;
    --room_;
  }

  Rgb total() {
    flush(exponent_);
    return {static_cast<float>(red_), static_cast<float>(green_total_), static_cast<float>(blue_)};
  }

 private:
  static constexpr std::uint64_t kMantissa = (1u << kFluxBits) - 1;
  static constexpr std::uint64_t kRedBlue = kMantissa | kMantissa << (2 * kFluxBits);
  /// Blue has the bits above 2 kFluxBits to grow in: 10 more than one mantissa.
  static constexpr int kRoom = 1 << (64 - 3 * kFluxBits);

  void flush(std::uint32_t next_exponent) {
    const std::int64_t power = std::int64_t{exponent_} - kFluxExponentBias - kFluxBits;
    const auto scale = std::bit_cast<double>(static_cast<std::uint64_t>(power + 1023) << 52);
    red_ += static_cast<double>(red_blue_ & ((std::uint64_t{1} << (2 * kFluxBits)) - 1)) * scale;
    blue_ += static_cast<double>(red_blue_ >> (2 * kFluxBits)) * scale;
    green_total_ += static_cast<double>(green_) * scale;
    red_blue_ = green_ = 0;
    exponent_ = next_exponent;
    room_ = kRoom;
  }

  std::uint64_t red_blue_ = 0;  // both mantissas' sums, blue from bit 2 kFluxBits up
  std::uint64_t green_ = 0;
  std::uint32_t exponent_ = 0;
  int room_ = kRoom;
  double red_ = 0, green_total_ = 0, blue_ = 0;
};

}  // namespace octolux
