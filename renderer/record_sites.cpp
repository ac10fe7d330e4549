// record_sites.h.
#include "renderer/record_sites.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "accel/block_distances.h"
#include "accel/photon_tree_walk.h"
#include "core/constants.h"

namespace octolux {

namespace {

constexpr std::uint32_t kNone = PhotonTreeWalk::kEnd;
constexpr std::uint32_t kBlockSize = PhotonTree::kBlockSize;
/// Between the normals of a record and of a point it serves, geometric and shading ones each.
constexpr float kMinCosine = 0.95f;

/// The density of photons is told by the distance of so many.
constexpr std::size_t kCounted = 4;

/// A tree over the finite ones of some places, and what lies in its slots.
struct Sorted {
  PhotonTree tree;
  std::vector<PhotonTree::Item> slots;
};
template <class Place>
Sorted sorted_by_place(const std::vector<Place>& places, Vec3 Place::*normal) {
  Sorted sorted;
  std::vector<FacingSet> facing;
  for (const Place& place : places) {
    const auto index = static_cast<std::uint32_t>(facing.size());
    facing.push_back(octolux::facing(place.*normal));
    const bool finite = is_finite(place.position) && is_finite(place.*normal);
    if (finite) sorted.slots.push_back({place.position, index});
  }
  sorted.tree = PhotonTree(sorted.slots, facing);
  return sorted;
}

}  // namespace

/// Squared distances [m^2] of the nearest few.
class RecordSites::Closest {
 public:
  explicit Closest(float farthest) { distances2_.fill(farthest * farthest); }
  float last2() const { return distances2_.back(); }
  void add(float distance2) {
    if (!(distance2 < last2())) return;
    std::size_t place = kCounted - 1;
    for (; place > 0 && distance2 < distances2_[place - 1]; --place)
      distances2_[place] = distances2_[place - 1];
    distances2_[place] = distance2;
  }

 private:
  std::array<float, kCounted> distances2_;  // sorted
};

RecordSites::RecordSites(const std::vector<RecordSite>& sites, const std::vector<Photon>& photons,
                         const Bandwidth& bandwidth, int neighbours, double reuse) {
  Sorted sorted = sorted_by_place(sites, &RecordSite::ng);
  for (const PhotonTree::Item& slot : sorted.slots) {
    const RecordSite& site = slot.index == PhotonTree::kNone ? RecordSite{} : sites[slot.index];
    surfaces_.push_back({site.ng, site.ns, site.error});
  }
  sites_ = std::move(sorted.tree);

  sorted = sorted_by_place(photons, &Photon::normal);
  for (const PhotonTree::Item& slot : sorted.slots) {
    normals_.push_back(slot.index == PhotonTree::kNone ? Vec3{} : photons[slot.index].normal);
  }
  photons_ = std::move(sorted.tree);

  const float per_bandwidth = std::sqrt(static_cast<float>(neighbours) / kCounted);
  reach_ = static_cast<float>(reuse) * std::pow(bandwidth.shrink, 1.5f) * per_bandwidth;
  max_spacing_ = bandwidth.max_radius / per_bandwidth;
}

std::optional<RecordSites::Found> RecordSites::find(const PhotonQuery& query,
                                                    Vec3 shading_normal) const {
  Found best{kNone, max_spacing_ * max_spacing_};
  PhotonTreeWalk walk(sites_, query.position, facing_near(query.normal));
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(best.distance2);
    if (b == kNone) break;
    const BlockDistances block(sites_.block(b), query);
    // Nearest first: normals are far away in memory, and the first that agree will do.
    for (std::uint32_t near = block.nearer_than(best.distance2); near != 0;) {
      const std::uint32_t lane = block.nearest_of(near);
      const std::uint32_t site = b * kBlockSize + lane;
      near &= ~(1u << lane);
      if (!(dot(surfaces_[site].ng, query.normal) > kMinCosine)) continue;
      if (!(dot(surfaces_[site].ns, shading_normal) > kMinCosine)) continue;
      best = {site, block.distance2[lane]};
      break;
    }
  }
  if (best.record == kNone) return std::nullopt;
  return best;
}

/// Adds the distances of photons on surfaces that face one of these ways and whose normals count.
template <class Counts>
void RecordSites::look_around(const PhotonQuery& query, FacingSet facing, Closest& nearest,
                              const Counts& counts) const {
  PhotonTreeWalk walk(photons_, query.position, facing);
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(nearest.last2());
    if (b == kNone) return;
    const BlockDistances block(photons_.block(b), query);
    for (std::uint32_t near = block.nearer_than(nearest.last2()); near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      // A site that is a photon does not count itself.
      if (block.distance2[lane] == 0) continue;
      if (counts(normals_[b * kBlockSize + lane])) nearest.add(block.distance2[lane]);
    }
  }
}

float RecordSites::spacing(Vec3 position, Vec3 normal) const {
  const PhotonQuery query{.position = position, .normal = normal};
  Closest nearest(max_spacing_);
  look_around(query, facing_near(normal), nearest,
              [&](Vec3 other) { return dot(other, normal) > kMinCosine; });
  return std::sqrt(nearest.last2());
}

bool RecordSites::is_detail(Vec3 position, Vec3 normal, float spacing) const {
  const PhotonQuery ball{.position = position, .normal = normal, .squash = 1};
  Closest nearest(spacing);
  look_around(ball, facing_across(normal), nearest,
              [&](Vec3 other) { return std::abs(dot(other, normal)) < kFacingCosine; });
  return nearest.last2() < spacing * spacing;
}

SurfacePoint RecordSites::point(std::uint32_t record) const {
  SurfacePoint point;
  point.position = sites_.position(record);
  point.ng = surfaces_[record].ng;
  point.ns = surfaces_[record].ns;
  point.error = surfaces_[record].error;
  return point;
}

}  // namespace octolux
