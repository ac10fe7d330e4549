// free_region.h: what the feelers say about the sectors between them.
#include "estimators/free_region.h"

#include <algorithm>

#include "estimators/sector_integral.h"

namespace octolux {

namespace {

constexpr float kShort = 1 - 0x1p-8f;  // how near to its target a verifying ray must come
constexpr float kSameLine = 0x1p-10f;  // [rad] and, times the feelers' length, [m]

/// Two neighbouring feelers and what is between them.
struct Gap {
  Feeler a, b;
  HalfPlane third;
  bool cut = false;  // back to the chord?

  bool holds(Vec2 p) const { return cross(a.direction, p) >= 0 && cross(p, b.direction) >= 0; }
  bool inside(Vec2 p, float slack) const {
    return (!a.has_line() || dot(a.line.a, p) <= a.line.c + slack) &&
           (!b.has_line() || dot(b.line.a, p) <= b.line.c + slack);
  }
};

bool same_line(const HalfPlane& a, const HalfPlane& b, float length) {
  return std::abs(cross(a.a, b.a)) < kSameLine && dot(a.a, b.a) > 0 &&
         std::abs(a.c - b.c) < kSameLine * length;
}

/// Do the two feelers leave nothing open? A feeler that just ends has no line to agree on.
bool settled(const Gap& gap, float length) {
  if (gap.a.open && gap.b.open) return true;
  return gap.a.has_line() && gap.b.has_line() && same_line(gap.a.line, gap.b.line, length);
}

bool must_cut(const Gap& gap) {
  return (!gap.a.open && !gap.a.has_line()) || (!gap.b.open && !gap.b.has_line());
}

Vec2 middle(const Gap& gap, float length) {
  const Vec2 sum = gap.a.direction + gap.b.direction;
  const Vec2 direction = sum * (1 / octolux::length(sum));
  float end = length;
  for (const Feeler* f : {&gap.a, &gap.b}) {
    const float slope = f->has_line() ? dot(f->line.a, direction) : 0;
    if (slope > 0) end = std::min(end, f->line.c / slope);
  }
  return direction * end;
}

/// The farthest corner of what both feelers leave of the sector within `length`.
Vec2 target(const Gap& gap, float length) {
  const HalfPlane &a = gap.a.line, &b = gap.b.line;
  if (gap.a.has_line() && gap.b.has_line()) {
    const float determinant = cross(a.a, b.a);
    const Vec2 corner =
        Vec2{a.c * b.a.y - b.c * a.a.y, b.c * a.a.x - a.c * b.a.x} * (1 / determinant);
    if (gap.holds(corner) && octolux::length(corner) < length) return corner;
  }
  for (const Feeler* f : {&gap.a, &gap.b}) {
    if (!f->has_line() || f->line.c >= length) continue;
    const float half = std::sqrt(length * length - f->line.c * f->line.c);
    const Vec2 foot = f->line.a * f->line.c;
    const Vec2 along{-f->line.a.y * half, f->line.a.x * half};
    for (const Vec2 p : {foot + along, foot - along}) {
      if (gap.holds(p) && gap.inside(p, kSameLine * length)) return p;
    }
  }
  return middle(gap, length);
}

/// Sends a feeler, and a probe, to the corner of each gap that is not settled.
void verify(const RayCaster& caster, const FeelerQuery& query, const TangentPlane& plane,
            std::array<Gap, RayPacket::kSize>& gaps) {
  const Vec2 start = plane.project(plane.start);
  std::array<Vec2, RayPacket::kSize> targets;
  RayPacket packet;
  std::uint32_t lanes = 0;
  for (int i = 0; i < query.feelers; ++i) {
    if (settled(gaps[i], query.length)) continue;
    gaps[i].cut = must_cut(gaps[i]);
    const Vec2 inwards = (gaps[i].a.line.a + gaps[i].b.line.a) * (-2 * plane.lift);
    targets[i] = target(gaps[i], query.length) * kShort + inwards;
    lanes |= 1u << i;
    const Vec2 way = targets[i] - start;
    const float size = length(way);
    if (!(size > 4 * plane.lift)) continue;
    packet.rays[i] = {plane.start, plane.direction(way * (1 / size)), 0, size - 4 * plane.lift};
    packet.active |= 1u << i;
  }
  if (lanes == 0) return;
  const auto hits = caster.closest_hits(packet);
  for (int i = 0; i < query.feelers; ++i) {
    if (!hits[i].hit()) continue;
    Gap& gap = gaps[i];
    gap.cut = true;
    if (plane.agrees(hits[i].normal)) continue;
    const Ray& ray = packet.rays[i];
    const Vec2 direction{dot(ray.direction, plane.s), dot(ray.direction, plane.t)};
    gap.third = plane.free_side(hits[i].normal, ray.origin + ray.direction * hits[i].t, direction);
  }
  if (!query.edges) return;
  const std::uint32_t present = surface_at(caster, query, plane, targets, lanes);
  for (int i = 0; i < query.feelers; ++i) gaps[i].cut |= (lanes & ~present) >> i & 1;
}

/// The half plane on this side of the line through the feelers' ends.
HalfPlane chord(const Gap& gap) {
  const Vec2 p = gap.a.tip(), way = gap.b.tip() - p;
  const float size = length(way);
  const Vec2 between = gap.a.direction + gap.b.direction;
  const Vec2 a = size > 0 ? Vec2{way.y, -way.x} * (1 / size) : between * (1 / length(between));
  return {a, std::max(dot(a, p), 0.0f)};
}

}  // namespace

FreeRegion::FreeRegion(Vec3 normal) {
  const Frame frame = Frame::from_normal(normal);
  region_.s = frame.s;
  region_.t = frame.t;
  region_.clearance = kInfinity;
}

FreeRegion::FreeRegion(const RayCaster& caster, const FeelerQuery& query) {
  TangentPlane plane(query);
  plane.avoid_overhang(caster, query.wo);
  region_.s = plane.s;
  region_.t = plane.t;
  region_.clearance = kInfinity;
  reach_ = query.length * std::cos(kPi / static_cast<float>(query.feelers));
  Feelers feelers = trace_feelers(caster, query, plane);
  if (query.edges) stop_at_edges(caster, query, plane, feelers);
  std::array<Gap, RayPacket::kSize> gaps;
  for (int i = 0; i < feelers.count; ++i) {
    gaps[i].a = feelers.all[i];
    gaps[i].b = feelers.all[(i + 1) % feelers.count];
  }
  verify(caster, query, plane, gaps);
  for (int sector = 0; sector < PhotonRegion::kSectors; ++sector) {
    const Gap& gap = gaps[sector * feelers.count / PhotonRegion::kSectors];
    add(sector, 0, gap.a.line);
    add(sector, 1, gap.b.line);
    add(sector, 2, gap.third);
    if (gap.cut) add(sector, 3, chord(gap));
  }
}

void FreeRegion::add(int sector, int slot, HalfPlane line) {
  region_.sectors[sector].set(slot, line);
  region_.clearance = std::min(region_.clearance, line.c);
}

float FreeRegion::extent() const {
  const bool open = std::any_of(region_.sectors.begin(), region_.sectors.end(), [&](const auto& s) {
    return *std::min_element(s.c.begin(), s.c.end()) >= reach_;
  });
  if (open) return kInfinity;
  float extent = 0;
  for (int i = 0; i < PhotonRegion::kSectors && extent < reach_; ++i) {
    extent = std::max(extent, sector_extent(region_.sectors[i], i, reach_));
  }
  return extent < reach_ ? extent : kInfinity;
}

double FreeRegion::integral(float h, float taper) const {
  double sum = 0;
  for (int i = 0; i < PhotonRegion::kSectors; ++i) {
    const auto& c = region_.sectors[i].c;
    const bool whole = *std::min_element(c.begin(), c.end()) >= h;
    sum += whole ? std::numbers::pi / 8 * (1 - 0.5 * taper) * h * h
                 : sector_integral(region_.sectors[i], i, h, taper);
  }
  return sum;
}

double FreeRegion::area_in_box(float h, std::span<const float, 8> box) const {
  double sum = 0;
  for (int sector = 0; sector < PhotonRegion::kSectors; ++sector) {
    std::array<HalfPlane, 4> sides;  // those at less than 90 degrees to some of the sector
    for (int i = 0; i < 4; ++i) {
      const int side = (sector + i + 7) % 8;
      sides[i] = {kEightDirections[side], box[side]};
    }
    sum += sector_integral(region_.sectors[sector], sector, h, 0, sides);
  }
  return sum;
}

PhotonRegion feeler_box(const RayCaster& caster, const FeelerQuery& query) {
  const TangentPlane plane(query);
  PhotonRegion region;
  region.s = plane.s;
  region.t = plane.t;
  RayPacket packet;
  const int step = RayPacket::kSize / query.feelers;
  const float error = query.point.error;
  for (int i = 0; i < RayPacket::kSize; ++i) {
    packet.rays[i] = {plane.origin + plane.n * error, plane.direction(kEightDirections[i]), 0,
                      query.length};
    packet.active |= i % step == 0 ? 1u << i : 0;
  }
  const auto hits = caster.closest_hits(packet);
  for (int sector = 0; sector < PhotonRegion::kSectors; ++sector) {
    for (int slot = 0; slot < PhotonRegion::kLines; ++slot) {
      const int i = (sector + slot + RayPacket::kSize - 1) % RayPacket::kSize;
      if (hits[i].hit()) region.sectors[sector].set(slot, {kEightDirections[i], hits[i].t});
    }
  }
  return region;
}

}  // namespace octolux
