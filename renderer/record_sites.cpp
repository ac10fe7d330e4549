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

/// The density of sites is told by the distance of so many.
constexpr std::size_t kCounted = 4;

}  // namespace

std::int64_t record_paths(std::int64_t photons, const Bandwidth& bandwidth) {
  constexpr double kShare = 0.2;  // of the photons, where the bandwidth is not yet shrunk
  const double share = std::min(1.0, kShare / (bandwidth.shrink * bandwidth.shrink));
  return static_cast<std::int64_t>(share * static_cast<double>(photons));
}

RecordSites::RecordSites(const std::vector<Photon>& photons, const Bandwidth& bandwidth,
                         int neighbours, double reuse) {
  std::vector<PhotonTree::Item> items;
  std::vector<FacingSet> facing;
  for (const Photon& photon : photons) {
    const auto index = static_cast<std::uint32_t>(facing.size());
    facing.push_back(octolux::facing(photon.normal));
    if (is_usable(photon)) items.push_back({photon.position, index});
  }
  tree_ = PhotonTree(items, facing);
  sites_.resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].index == PhotonTree::kNone) continue;
    const Photon& photon = photons[items[i].index];
    sites_[i] = {photon.normal, photon.ns, photon.error};
  }
  const float share = static_cast<float>(reuse) * bandwidth.shrink;
  scale_ = share * std::sqrt(static_cast<float>(neighbours) / kCounted);
  max_reach_ = share * bandwidth.max_radius;
}

std::optional<RecordSites::Found> RecordSites::find(const PhotonQuery& query,
                                                    Vec3 shading_normal) const {
  Found best{kNone, max_reach_ * max_reach_};
  PhotonTreeWalk walk(tree_, query.position, facing_near(query.normal));
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(best.distance2);
    if (b == kNone) break;
    const BlockDistances block(tree_.block(b), query);
    for (std::uint32_t near = block.nearer_than(best.distance2); near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      const std::uint32_t site = b * kBlockSize + lane;
      if (!(block.distance2[lane] < best.distance2)) continue;
      if (!(dot(sites_[site].ng, query.normal) > kMinCosine)) continue;
      if (!(dot(sites_[site].ns, shading_normal) > kMinCosine)) continue;
      best = {site, block.distance2[lane]};
    }
  }
  if (best.record == kNone) return std::nullopt;
  return best;
}

float RecordSites::reach(std::uint32_t record) const {
  const Vec3 normal = sites_[record].ng;
  const PhotonQuery query{.position = tree_.position(record), .normal = normal};
  std::array<float, kCounted> nearest;  // squared distances, sorted
  const float farthest = max_reach_ / scale_;
  nearest.fill(farthest * farthest);
  PhotonTreeWalk walk(tree_, query.position, facing_near(normal));
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(nearest.back());
    if (b == kNone) break;
    const BlockDistances block(tree_.block(b), query);
    for (std::uint32_t near = block.nearer_than(nearest.back()); near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      const std::uint32_t site = b * kBlockSize + lane;
      const float distance2 = block.distance2[lane];
      if (site == record || !(distance2 < nearest.back())) continue;
      if (!(dot(sites_[site].ng, normal) > kMinCosine)) continue;
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
  point.position = tree_.position(record);
  point.ng = sites_[record].ng;
  point.ns = sites_[record].ns;
  point.error = sites_[record].error;
  return point;
}

}  // namespace octolux
