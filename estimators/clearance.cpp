// clearance.h.
//
// A triangle can stop a feeler only if it passes through the feelers' height. It is then no nearer
// than its bounds, nor than the line in which its plane does so. Triangles within the surface's own
// plane (up to the lift, which feelers step over as well) tile it: where an edge has no second such
// triangle on its other side the surface may end.
#include "estimators/clearance.h"

#include <algorithm>

namespace octolux {

namespace {

constexpr int kMostShown = 32;  // more triangles cost more than feelers
constexpr int kMostTiles = 8;   // more are too many to compare

class Obstacles {
 public:
  Obstacles(const FeelerQuery& query, float distance, float least)
      : origin_(query.point.position),
        n_(query.normal),
        edges_(query.edges),
        lift_(feeler_lift(query)),
        least_(least),
        free_(distance) {}

  /// How far there may be more that matters.
  float visit(const NearPrimitive& near) {
    if (++shown_ > kMostShown) return free_ = 0;
    if (!near.triangle) return meet(near.distance);
    const std::array<Vec3, 3> p{near.corners[0] - origin_, near.corners[1] - origin_,
                                near.corners[2] - origin_};
    const float nearest = distance_to_bounds(p);
    if (nearest >= free_) return free_;
    const float za = dot(p[0], n_), zb = dot(p[1], n_), zc = dot(p[2], n_);
    const float low = std::min(std::min(za, zb), zc), high = std::max(std::max(za, zb), zc);
    if (high > 0.5f * lift_ && low < 2 * lift_) {
      return meet(std::max(nearest, distance_to_wall(p)));
    }
    if (edges_ && high <= 0.5f * lift_ && low >= -0.5f * lift_) add_tile(near.id, p);
    return free_;
  }

  float free() const {
    if (!edges_ || free_ == 0) return free_;
    float free = free_;
    bool here = false;
    for (int i = 0; i < tile_count_; ++i) {
      here = here || contains_origin(tiles_[i]);
      for (int k = 0; k < 3; ++k) {
        const float edge = distance_to_edge(tiles_[i], k);
        if (edge < free && !goes_on(i, k)) free = edge;
      }
    }
    return here && free >= least_ ? free : 0;
  }

 private:
  float meet(float distance) {
    if (distance < free_) free_ = distance >= least_ ? distance : 0;
    return free_;
  }

  static float distance_to_bounds(const std::array<Vec3, 3>& p) {
    const Vec3 lower = min(min(p[0], p[1]), p[2]), upper = max(max(p[0], p[1]), p[2]);
    return length(max(max(lower, -upper), Vec3{0, 0, 0}));
  }

  struct Tile {
    std::uint64_t id;
    std::array<Vec3, 3> p;

    Vec3 from(int k) const { return p[k]; }
    Vec3 edge(int k) const { return p[(k + 1) % 3] - p[k]; }
    Vec3 opposite(int k) const { return p[(k + 2) % 3]; }
  };

  /// From the query to the line in which the triangle's plane is between lift/2 and 2 lift high.
  float distance_to_wall(const std::array<Vec3, 3>& p) const {
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const float up = dot(normal, n_);
    const float across = length(normal - n_ * up);
    const float offset = dot(normal, p[0]);
    const float low = offset - 0.5f * lift_ * up, high = offset - 2 * lift_ * up;
    if (!(across > 0) || low * high <= 0) return 0;
    return std::min(std::abs(low), std::abs(high)) / across;
  }

  void add_tile(std::uint64_t id, const std::array<Vec3, 3>& p) {
    for (int i = 0; i < tile_count_; ++i) {
      if (tiles_[i].id == id) return;
    }
    if (tile_count_ == kMostTiles) {
      free_ = 0;
    } else {
      tiles_[tile_count_++] = {id, p};
    }
  }

  /// On which side of edge k `p` is.
  float side(const Tile& tile, int k, Vec3 p) const {
    return dot(cross(tile.edge(k), p - tile.from(k)), n_);
  }
  bool contains_origin(const Tile& tile) const {
    const float a = side(tile, 0, {}), b = side(tile, 1, {}), c = side(tile, 2, {});
    return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
  }
  static float distance_to_edge(const Tile& tile, int k) {
    const Vec3 edge = tile.edge(k);
    const float along = -dot(tile.from(k), edge), length2 = dot(edge, edge);
    const float t = length2 > 0 ? std::clamp(along / length2, 0.0f, 1.0f) : 0;
    return length(tile.from(k) + edge * t);
  }
  /// Is there a tile on the other side of edge k of tile i?
  bool goes_on(int i, int k) const {
    const Vec3 a = tiles_[i].from(k), b = tiles_[i].p[(k + 1) % 3];
    const float inner = side(tiles_[i], k, tiles_[i].opposite(k));
    for (int j = 0; j < tile_count_; ++j) {
      for (int m = 0; m < 3 && j != i; ++m) {
        const Vec3 c = tiles_[j].from(m), d = tiles_[j].p[(m + 1) % 3];
        const bool same = (a == c && b == d) || (a == d && b == c);
        if (same && side(tiles_[i], k, tiles_[j].opposite(m)) * inner < 0) return true;
      }
    }
    return false;
  }

  Vec3 origin_, n_;
  bool edges_;
  float lift_, least_;
  float free_;  // [m] nothing was met nearer; 0: given up
  int shown_ = 0, tile_count_ = 0;
  std::array<Tile, kMostTiles> tiles_;  // relative to the query
};

}  // namespace

float free_distance(const RayCaster& caster, const FeelerQuery& query, float distance,
                    float least) {
  constexpr float kRounding = 1 + 0x1p-16f;
  Obstacles obstacles(query, distance * kRounding, least);
  const auto visit = [](void* visitor, const NearPrimitive& near) {
    return static_cast<Obstacles*>(visitor)->visit(near);
  };
  caster.visit_near(query.point.position, distance * kRounding, visit, &obstacles);
  return std::min(obstacles.free() / kRounding, distance);
}

}  // namespace octolux
