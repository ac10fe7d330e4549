// feelers.h: the rays along the tangent plane. What happens under them: surface_edges.cpp.
#include "estimators/feelers.h"

#include <algorithm>

#include "core/frame.h"

namespace octolux {

namespace {

/// Heights [feeler lengths] by which a feeler climbs each time it meets its own surface.
constexpr std::array<float, 2> kClimbs{0x1p-5f, 0.42f};
constexpr float kLift = 0x1p-10f;       // [feeler lengths]
constexpr float kFlattestWall = 1e-3f;  // sine to the tangent plane below which a wall has no line

/// Ends `feeler` at the hit, unless the surface goes on there: then true, and `ray` goes on.
bool goes_on(const TangentPlane& plane, const PacketHit& hit, float climb, float length,
             Feeler& feeler, Ray& ray) {
  const Vec3 p = ray.origin + ray.direction * hit.t;
  const float along = dot(plane.project(p), feeler.direction);
  feeler.height = plane.height(p);
  if (plane.agrees(hit.normal) && climb > 0) {
    ray.origin = p + plane.n * (climb * length);
    ray.t_max = length - along;
    feeler.height += climb * length;
    return ray.t_max > 0;
  }
  feeler.open = false;
  feeler.line = plane.agrees(hit.normal) ? HalfPlane{feeler.direction, std::max(along, 0.0f)}
                                         : plane.free_side(hit.normal, p, feeler.direction);
  feeler.end = std::min(feeler.line.c / dot(feeler.line.a, feeler.direction), length);
  return false;
}

}  // namespace

float feeler_lift(const FeelerQuery& query) { return 2 * query.point.error + kLift * query.length; }

TangentPlane::TangentPlane(const FeelerQuery& query)
    : origin(query.point.position), n(query.normal) {
  const Frame frame = Frame::from_normal(n);
  const float angle = query.turn * (2 * kPi / static_cast<float>(query.feelers));
  s = frame.s * std::cos(angle) + frame.t * std::sin(angle);
  t = cross(n, s);
  lift = feeler_lift(query);
  move_start(query.wo, std::min(32 * query.point.error + lift / 64, way_to_viewer(query.wo)));
}

void TangentPlane::avoid_overhang(const RayCaster& caster, Vec3 wo) {
  const float up = 0.75f * lift;
  if (caster.occluded({start - n * up, n, 0, up})) move_start(wo, way_to_viewer(wo));
}

void TangentPlane::move_start(Vec3 wo, float way) {
  start = origin + wo * way + n * (lift - way * std::max(dot(wo, n), 0.0f));
}

/// How far towards the viewer the feelers' height is reached, or nearly.
float TangentPlane::way_to_viewer(Vec3 wo) const {
  const float cosine = dot(wo, n);
  return cosine > 0.25f ? lift / cosine : 4 * lift;
}

HalfPlane TangentPlane::free_side(Vec3 wall_normal, Vec3 p, Vec2 fallback) const {
  const Vec2 a{-dot(wall_normal, s), -dot(wall_normal, t)};
  const float sine = octolux::length(a);
  if (!(sine > kFlattestWall)) return {fallback, std::max(dot(project(p), fallback), 0.0f)};
  return {a * (1 / sine), std::max(-dot(wall_normal, p - origin) / sine, 0.0f)};
}

Feelers trace_feelers(const RayCaster& caster, const FeelerQuery& query,
                      const TangentPlane& plane) {
  Feelers feelers;
  feelers.count = query.feelers;
  RayPacket packet;
  for (int i = 0; i < feelers.count; ++i) {
    Feeler& feeler = feelers.all[i];
    feeler.direction = kEightDirections[i * 8 / feelers.count];
    feeler.end = query.length;
    feeler.height = plane.lift;
    packet.rays[i] = {plane.start, plane.direction(feeler.direction), 0, query.length};
    packet.active |= 1u << i;
  }
  for (std::size_t round = 0; packet.active != 0; ++round) {
    const float climb = round < kClimbs.size() ? kClimbs[round] : 0;
    const auto hits = caster.closest_hits(packet);
    std::uint32_t again = 0;
    for (int i = 0; i < feelers.count; ++i) {
      if (!hits[i].hit()) continue;
      const bool on = goes_on(plane, hits[i], climb, query.length, feelers.all[i], packet.rays[i]);
      again |= static_cast<std::uint32_t>(on) << i;
    }
    packet.active = again;
  }
  return feelers;
}

}  // namespace octolux
