// Small scenes for tests of estimators that look at the geometry: quads under any similarity, and
// queries on their floor, z = 0 before the map.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "core/constants.h"
#include "core/rng.h"
#include "core/scattering.h"
#include "estimators/free_region.h"

namespace octolux::test {

inline Rng rng_of(std::uint64_t pass, std::uint64_t index = 0) {
  return Rng(20060131, Stream::test, pass, index);
}

/// Scale, then turn about z, then tilt about x, then shift.
struct Placement {
  float scale = 1, turn = 0, tilt = 0;  // angles in radians
  Vec3 shift;

  Vec3 vector(Vec3 v) const {
    const float c = std::cos(turn), s = std::sin(turn);
    const float ct = std::cos(tilt), st = std::sin(tilt);
    const Vec3 u{c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    return {u.x, ct * u.y - st * u.z, st * u.y + ct * u.z};
  }
  Vec3 point(Vec3 p) const { return vector(p) * scale + shift; }
};

class Room {
 public:
  explicit Room(Placement placement = {}) : placement_(placement) {}

  /// Anticlockwise corners.
  void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (const Vec3 p : {a, b, c, d}) mesh_.positions.push_back(placement_.point(p));
    mesh_.triangles.push_back({first, first + 1, first + 2});
    mesh_.triangles.push_back({first, first + 2, first + 3});
  }
  /// A rectangle of the plane z.
  void floor(float x0, float y0, float x1, float y1, float z = 0) {
    quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
  }
  /// A vertical rectangle without thickness over the segment p q.
  void wall(Vec2 p, Vec2 q, float z0 = 0, float z1 = 3) {
    quad({p.x, p.y, z0}, {q.x, q.y, z0}, {q.x, q.y, z1}, {p.x, p.y, z1});
  }
  /// Walls between consecutive points.
  void walls(const std::vector<Vec2>& points, bool closed, float z0 = 0, float z1 = 3) {
    const std::size_t n = points.size();
    for (std::size_t i = 0; i + 1 < n + (closed ? 1 : 0); ++i) {
      wall(points[i], points[(i + 1) % n], z0, z1);
    }
  }
  /// Walls and lid over a rectangle.
  void box(float x0, float y0, float x1, float y1, float z0, float z1) {
    walls({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, true, z0, z1);
    floor(x0, y0, x1, y1, z1);
  }
  void add(const Quadric& quadric) { shapes_.push_back({quadric, 0, -1, "quadric"}); }

  const RayCaster& caster() {
    if (!caster_) {
      if (!mesh_.triangles.empty()) shapes_.push_back({mesh_, 0, -1, "mesh"});
      caster_ = std::make_unique<RayCaster>(shapes_);
    }
    return *caster_;
  }
  const Placement& placement() const { return placement_; }

  /// The surface seen at (x, y) from the height z above it; no value if there is none.
  std::optional<SurfacePoint> look_down(Vec2 p, float z = 1) {
    const Ray ray{placement_.point({p.x, p.y, z}), placement_.vector({0, 0, -1})};
    const std::optional<RayHit> hit = caster().closest(ray);
    if (!hit) return std::nullopt;
    return caster().surface(*hit);
  }

 private:
  Placement placement_;
  TriangleMesh mesh_;
  std::vector<Shape> shapes_;
  std::unique_ptr<RayCaster> caster_;
};

/// A tunnel's floor or a barrel's back: half a cylinder of radius 2 about the x axis, its lowest
/// (bend 1) or highest (-1) line at z = 0.
inline void add_half_cylinder(Room& room, int facets, float bend) {
  for (int i = 0; i < facets; ++i) {
    const auto at = [&](float x, int k) {
      const float angle = kPi * static_cast<float>(k) / static_cast<float>(facets);
      return Vec3{x, -2 * std::cos(angle), 2 * bend * (1 - std::sin(angle))};
    };
    room.quad(at(-20, i), at(20, i), at(20, i + 1), at(-20, i + 1));
  }
}

/// A query at (x, y) on the floor, seen from straight above; `length` of the feelers before the
/// map.
inline FeelerQuery query_at(Room& room, Vec2 p, float length, float turn, float z = 1) {
  FeelerQuery query;
  query.point = room.look_down(p, z).value();
  query.wo = room.placement().vector({0, 0, 1});
  query.normal = dot(query.point.ng, query.wo) < 0 ? -query.point.ng : query.point.ng;
  query.length = length * room.placement().scale;
  query.turn = turn;
  return query;
}

/// The same at a point where looking down may meet a wall instead: as `floor`, but at p.
inline FeelerQuery moved_to(const Room& room, FeelerQuery floor, Vec2 p) {
  floor.point.position = room.placement().point({p.x, p.y, 0});
  return floor;
}

}  // namespace octolux::test
