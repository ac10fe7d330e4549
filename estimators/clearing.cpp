// clearing.h. A sector between two feelers is free as far as a straight wall leaves it that stops
// neither of them.
#include "estimators/clearing.h"

#include <algorithm>

#include "estimators/octobox.h"

namespace octolux {

namespace {

constexpr float kHalfSector = 0.92387953f;  // cos(22.5 degrees)
constexpr float kBeyond = 1.01f;            // so that an open sector reaches all of it

}  // namespace

Clearing Clearing::around(const RayCaster& caster, const SurfacePoint& point, float reach) {
  FeelerQuery query{.point = point, .normal = point.ng, .wo = point.ng, .edges = false};
  query.length = reach * kBeyond / kHalfSector;
  const Feelers feelers = trace_feelers(caster, query, TangentPlane(query));
  Clearing clearing;
  for (int i = 0; i < feelers.count; ++i) {
    const float end = std::min(feelers.all[i].end, feelers.all[(i + 1) % feelers.count].end);
    clearing.free_[i] =
        static_cast<std::uint8_t>(kSteps * std::clamp(end * kHalfSector / reach, 0.0f, 1.0f));
  }
  return clearing;
}

bool Clearing::contains(Vec3 normal, Vec3 across, float reach) const {
  const Frame frame = Frame::from_normal(normal);
  const float free = free_[octant(dot(across, frame.s), dot(across, frame.t))] * (reach / kSteps);
  return dot(across, across) <= free * free;
}

}  // namespace octolux
