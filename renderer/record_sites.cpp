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

  const float share = static_cast<float>(reuse) * std::pow(bandwidth.shrink, 1.5f);
  scale_ = share * std::sqrt(static_cast<float>(neighbours) / kCounted);
  max_reach_ = share * bandwidth.max_radius;
}

std::optional<RecordSites::Found> RecordSites::find(const PhotonQuery& query,
                                                    Vec3 shading_normal) const {
  Found best{kNone, max_reach_ * max_reach_};
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

float RecordSites::reach(std::uint32_t record) const {
  const Vec3 normal = surfaces_[record].ng;
  const PhotonQuery query{.position = sites_.position(record), .normal = normal};
  std::array<float, kCounted> nearest;  // squared distances, sorted
  const float farthest = max_reach_ / scale_;
  nearest.fill(farthest * farthest);
  PhotonTreeWalk walk(photons_, query.position, facing_near(normal));
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(nearest.back());
    if (b == kNone) break;
    const BlockDistances block(photons_.block(b), query);
    for (std::uint32_t near = block.nearer_than(nearest.back()); near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      const std::uint32_t photon = b * kBlockSize + lane;
      const float distance2 = block.distance2[lane];
      // A site that is a photon does not count itself.
      if (distance2 == 0 || !(distance2 < nearest.back())) continue;
      if (!(dot(normals_[photon], normal) > kMinCosine)) continue;
      std::size_t place = kCounted - 1;
      for (; place > 0 && distance2 < nearest[place - 1]; --place)
        nearest[place] = nearest[place - 1];
      nearest[place] = distance2;
    }
  }
  return scale_ * std::sqrt(nearest.back());
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
