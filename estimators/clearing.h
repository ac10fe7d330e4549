// How far the surface around a point is free, kept in eight bytes: what feelers found, for those who
// ask again and again whether the point sees one near to it. Most answers then need no ray.
#pragma once

#include <array>
#include <cstdint>

#include "estimators/feelers.h"

namespace octolux {

/// Made for a reach [m]. Immutable.
class Clearing {
 public:
  Clearing() = default;
  /// Sends feelers around the point, whose front side counts.
  static Clearing around(const RayCaster& caster, const SurfacePoint& point, float reach);

  /// Is nothing known to be between the point and what is `across` [m] from it, no farther than
  /// `reach`? What is seen from the point under less than 45 degrees may slip between two feelers.
  bool contains(Vec3 normal, Vec3 across, float reach) const;

 private:
  static constexpr float kSteps = 255;
  std::array<std::uint8_t, RayPacket::kSize> free_{};  // [reach / kSteps] in sector i
};

}  // namespace octolux
