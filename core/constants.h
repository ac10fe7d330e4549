// Mathematical constants in single precision.
#pragma once

#include <limits>
#include <numbers>

namespace octolux {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Largest float below 1.
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

}  // namespace octolux
