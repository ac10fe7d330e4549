// clearing.h. A sector between two feelers is free as far as a straight wall leaves it that stops
// neither of them.
#include "estimators/clearing.h"

#include <algorithm>

#include "estimators/octobox.h"

namespace octolux {

namespace {

constexpr float kHalfSector = 0.92387953f;  // cos(22.5 degrees)
constexpr float kBeyond = 1.01f;            // so that an open sector reaches all of it

FeelerQuery longer(FeelerQuery query) {
  query.length *= kBeyond / kHalfSector;
  return query;
}

}  // namespace

Clearing::Clearing(const RayCaster& caster, const FeelerQuery& query, const TangentPlane& plane) {
  const Feelers feelers = trace_feelers(caster, longer(query), plane);
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const float end = std::min(feelers.all[i].end, feelers.all[(i + 1) % free_.size()].end);
    const float share = std::clamp(end * kHalfSector / query.length, 0.0f, 1.0f);
    free_[i] = static_cast<std::uint8_t>(kSteps * share);
  }
}

bool Clearing::contains(Vec2 p, float reach) const {
  const float free = static_cast<float>(free_[octant(p.x, p.y)]) * (reach / kSteps);
  return dot(p, p) <= free * free;
}

}  // namespace octolux
