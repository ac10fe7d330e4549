// seen_photons.h.
#include "estimators/seen_photons.h"

#include <algorithm>
#include <vector>

#include "estimators/region_search.h"

namespace octolux {

namespace {

/// How near to its photon a ray must come: nearer than the thinnest wall in front of it.
constexpr float kShort = 1 - 0x1p-18f;
constexpr std::size_t kPacket = RayPacket::kSize;

TangentPlane tangent_plane(const GatherPoint& at, float radius) {
  FeelerQuery query = feeler_query(at, 8);
  query.length = radius;
  TangentPlane plane(query);
  plane.avoid_overhang(*at.caster, query.wo);
  return plane;
}

/// Rays to up to eight photons.
RayPacket rays_to(const TangentPlane& plane, const PhotonMap& map,
                  std::span<const Neighbour> photons) {
  const Vec2 start = plane.project(plane.start);
  RayPacket packet;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const Vec2 way = plane.project(map.position(photons[i].photon)) - start;
    const float distance = length(way);
    if (!(distance > 0)) continue;
    packet.rays[i] = {plane.start, plane.direction(way * (1 / distance)), 0, distance * kShort};
    packet.active |= 1u << i;
  }
  return packet;
}

}  // namespace

std::span<const Neighbour> seen_photons(const GatherPoint& at, const PhotonMap& map,
                                        std::span<const Neighbour> found, float radius) {
  if (at.caster == nullptr || found.empty()) return found;
  thread_local std::vector<Neighbour> seen;
  seen.clear();
  const TangentPlane plane = tangent_plane(at, radius);
  for (; !found.empty(); found = found.subspan(std::min(found.size(), kPacket))) {
    const std::span<const Neighbour> photons = found.first(std::min(found.size(), kPacket));
    const auto hits = at.caster->closest_hits(rays_to(plane, map, photons));
    for (std::size_t i = 0; i < photons.size(); ++i) {
      if (!hits[i].hit() || plane.agrees(hits[i].normal)) seen.push_back(photons[i]);
    }
  }
  return seen;
}

}  // namespace octolux
