// How far the surface around a point is free, kept in eight bytes: what feelers found, for those
// who ask again and again whether the point sees what is near to it. Most answers then need no ray.
#pragma once

#include <array>
#include <cstdint>

#include "estimators/feelers.h"

namespace octolux {

/// Immutable.
class Clearing {
 public:
  Clearing() = default;
  /// Sends eight feelers in the query's tangent plane. The clearing ends at query.length [m].
  Clearing(const RayCaster& caster, const FeelerQuery& query, const TangentPlane& plane);

  /// Is nothing known to be between the query and `p` [m], in the plane's axes? `reach`: the
  /// query's length, within which p is. What is seen under less than 45 degrees may slip between
  /// two feelers.
  bool contains(Vec2 p, float reach) const;
  /// Is that so of everything within the reach?
  bool whole() const { return free_ == kOpen; }

 private:
  using Sectors = std::array<std::uint8_t, RayPacket::kSize>;
  static constexpr float kSteps = 255;
  static constexpr Sectors kOpen{255, 255, 255, 255, 255, 255, 255, 255};
  Sectors free_{};  // [reach / kSteps] in sector i
};

}  // namespace octolux
