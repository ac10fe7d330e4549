// Free edges: where the surface under a feeler ends (a table's edge, a step down), feelers.h.
//
// Probe rays look down. The triangle they find says exactly where its edges are, so a search mostly
// needs two probes: one just behind the edge of the query's own triangle, one behind the next one's
// (the quad's diagonal). Where triangles go on after these and are much smaller than the feeler is
// long, the feeler's far end is probed next, and only if nothing is there the edge is searched by
// halving, with a look behind the nearest triangle's edge every other time. (The far end alone says
// little: it may lie on the next table, as high as this one.)
//
// A probe accepts a surface whose normal agrees and whose depth z fits its slope: on the query's
// own plane z = 0; any surface that bends away from it by the angle phi on the way r is within
// r tan(phi). A parallel surface below, a step, is not accepted.
#include <algorithm>
#include <optional>

#include "estimators/feelers.h"

namespace octolux {

namespace {

constexpr int kMaxProbes = 14;
/// A triangle is small if it ends before this part of a feeler and is nowhere wider, either.
constexpr float kSmall = 0.25f;
constexpr int kHops =
    2;  // looks behind edges of small triangles: that of a quad's half, its other's

/// Where a feeler leaves a triangle.
struct Exit {
  float at = -1;  // [m]; below 0: not known
  HalfPlane line;
  float width = 0;  // [m] of the triangle
};

/// A triangle in the tangent plane: its inside is that of three half planes. Not those of the
/// query: c < 0 where the query is outside.
struct Sides {
  std::array<HalfPlane, 3> lines;
  float width = 0;  // [m] least altitude
};

std::optional<Sides> sides_of(const RayCaster& caster, const TangentPlane& plane,
                              std::uint32_t shape, std::uint32_t primitive) {
  const auto triangle = caster.triangle(shape, primitive);
  if (!triangle) return std::nullopt;
  std::array<Vec2, 3> p;
  for (int i = 0; i < 3; ++i) p[i] = plane.project((*triangle)[i]);
  float area2 = cross(p[1] - p[0], p[2] - p[0]);
  if (area2 < 0) std::swap(p[1], p[2]);
  area2 = std::abs(area2);
  Sides sides;
  float longest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec2 edge = p[(i + 1) % 3] - p[i];
    const float size = length(edge);
    const Vec2 a = Vec2{edge.y, -edge.x} * (size > 0 ? 1 / size : 0);
    sides.lines[i] = {a, dot(a, p[i])};
    longest = std::max(longest, size);
  }
  if (longest > 0) sides.width = area2 / longest;
  return sides;
}

Exit exit_of(const Sides& sides, Vec2 direction) {
  Exit exit{kInfinity, {}, sides.width};
  for (const HalfPlane& side : sides.lines) {
    const float slope = dot(side.a, direction);
    const float c = std::max(side.c, 0.0f);
    if (slope > 0 && c < exit.at * slope) exit = {c / slope, {side.a, c}, sides.width};
  }
  return exit;
}

/// The query's own triangle, if it says which one that is.
std::optional<Sides> own_triangle(const RayCaster& caster, const FeelerQuery& query,
                                  const TangentPlane& plane) {
  const auto sides = sides_of(caster, plane, query.point.shape, query.point.primitive);
  if (!sides) return std::nullopt;
  for (const HalfPlane& side : sides->lines) {
    if (!(side.c >= -plane.lift)) return std::nullopt;
  }
  const Vec3 corner = (*caster.triangle(query.point.shape, query.point.primitive))[0];
  return std::abs(plane.height(corner)) <= plane.lift + 0x1p-10f * length(corner - plane.origin)
             ? sides
             : std::nullopt;
}

/// A ray down to the surface at `p`, from `above` it.
Ray probe_ray(const TangentPlane& plane, Vec2 p, float above) {
  return {plane.point(p, above), -plane.n, 0, above + length(p) + plane.lift};
}

/// Did the probe find the query's surface?
bool found(const TangentPlane& plane, const PacketHit& hit, const Ray& ray) {
  if (!hit.hit() || !plane.agrees(hit.normal)) return false;
  const Vec3 p = ray.origin + ray.direction * hit.t;
  const float cosine = dot(hit.normal, plane.n);
  const float slope = std::sqrt(std::max(0.0f, 1 - cosine * cosine)) / cosine;
  return std::abs(plane.height(p)) <= slope * length(plane.project(p)) + 2 * plane.lift;
}

/// The search along one feeler: there is surface up to `lo`, and none at `hi` once `missing`.
class Search {
 public:
  Search() = default;
  Search(const Feeler& feeler, const std::optional<Sides>& own, float tolerance)
      : direction_(feeler.direction),
        hi_(std::max(feeler.end - tolerance, 0.0f)),
        tolerance_(tolerance) {
    if (own) exit_ = exit_of(*own, direction_);
    choose();
  }

  bool done() const { return done_; }
  bool missing() const { return missing_; }
  Vec2 probe() const { return direction_ * probe_; }

  void present(const std::optional<Sides>& triangle) {
    lo_ = probe_;
    exit_ = triangle ? exit_of(*triangle, direction_) : Exit{};
    if (exit_.at >= 0) exit_.at = std::max(exit_.at, lo_);
    done_ = kind_ == Kind::far_end;
    if (!done_) choose();
  }

  void absent() {
    hi_ = probe_;
    missing_ = true;
    exact_ = done_ = kind_ == Kind::behind_exit;
    if (!done_) choose();
  }

  /// Shortens the feeler to the edge.
  void stop(Feeler& feeler) const {
    feeler.open = false;
    feeler.end = exact_ ? exit_.at : lo_;
    feeler.line = exact_ ? exit_.line : HalfPlane{};
  }

 private:
  enum class Kind { behind_exit, far_end, middle };

  void choose() {
    const bool known = exit_.at >= 0;
    const bool leaves = known && exit_.at + tolerance_ < hi_;
    if (!missing_) {
      done_ = known && !leaves;
      const bool large = std::max(exit_.at, exit_.width) >= kSmall * hi_;
      const bool hop = leaves && (large || hops_++ < kHops);
      kind_ = hop ? Kind::behind_exit : Kind::far_end;
    } else {
      done_ = hi_ - lo_ <= tolerance_;
      exact_ = known && !leaves;
      done_ = done_ || exact_;
      kind_ = leaves && kind_ != Kind::behind_exit ? Kind::behind_exit : Kind::middle;
    }
    probe_ = kind_ == Kind::behind_exit ? exit_.at + tolerance_
             : kind_ == Kind::far_end   ? hi_
                                        : 0.5f * (lo_ + hi_);
  }

  Vec2 direction_;
  float lo_ = 0, hi_ = 0, tolerance_ = 0, probe_ = 0;
  Exit exit_;
  Kind kind_ = Kind::far_end;
  int hops_ = 0;
  bool missing_ = false, exact_ = false, done_ = true;
};

}  // namespace

void stop_at_edges(const RayCaster& caster, const FeelerQuery& query, const TangentPlane& plane,
                   Feelers& feelers) {
  const std::optional<Sides> own = own_triangle(caster, query, plane);
  std::array<Search, RayPacket::kSize> searches;
  for (int i = 0; i < feelers.count; ++i) searches[i] = Search(feelers.all[i], own, plane.lift);
  for (int round = 0; round < kMaxProbes; ++round) {
    RayPacket packet;
    for (int i = 0; i < feelers.count; ++i) {
      if (searches[i].done()) continue;
      packet.rays[i] = probe_ray(plane, searches[i].probe(), feelers.all[i].height);
      packet.active |= 1u << i;
    }
    if (packet.active == 0) break;
    const auto hits = caster.closest_hits(packet);
    for (int i = 0; i < feelers.count; ++i) {
      if (searches[i].done()) continue;
      if (found(plane, hits[i], packet.rays[i])) {
        searches[i].present(sides_of(caster, plane, hits[i].shape, hits[i].primitive));
      } else {
        searches[i].absent();
      }
    }
  }
  for (int i = 0; i < feelers.count; ++i) {
    if (searches[i].missing()) searches[i].stop(feelers.all[i]);
  }
}

std::uint32_t surface_at(const RayCaster& caster, const FeelerQuery& query,
                         const TangentPlane& plane,
                         const std::array<Vec2, RayPacket::kSize>& points, std::uint32_t lanes) {
  const std::optional<Sides> own = own_triangle(caster, query, plane);
  RayPacket packet;
  std::uint32_t present = 0;
  for (int i = 0; i < RayPacket::kSize; ++i) {
    if (!(lanes >> i & 1)) continue;
    const float size = length(points[i]);
    const bool known = own && size > 0 && exit_of(*own, points[i] * (1 / size)).at >= size;
    packet.rays[i] = probe_ray(plane, points[i], plane.lift);
    (known ? present : packet.active) |= 1u << i;
  }
  if (packet.active == 0) return present;
  const auto hits = caster.closest_hits(packet);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const bool here = (packet.active >> i & 1) && found(plane, hits[i], packet.rays[i]);
    present |= static_cast<std::uint32_t>(here) << i;
  }
  return present;
}

}  // namespace octolux
