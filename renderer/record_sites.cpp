// record_sites.h.
#include "renderer/record_sites.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "accel/block_distances.h"
#include "accel/photon_tree_walk.h"
#include "core/constants.h"
#include "core/vec3d.h"

namespace octolux {

namespace {

constexpr std::uint32_t kNone = PhotonTreeWalk::kEnd;
constexpr std::uint32_t kBlockSize = PhotonTree::kBlockSize;
/// Between the normals of a record and of a point it serves, geometric and shading ones each.
constexpr float kMinCosine = 0.95f;

/// Area [m^2] per site in a block: two random points of a square are at a mean squared distance of
/// a third of its area, which is twice their mean squared distance from the middle.
float area_per_site(const PhotonTree::Block& block) {
  Vec3d sum{};
  double sum2 = 0, count = 0;
  const Vec3 first{block.x[0], block.y[0], block.z[0]};
  for (std::uint32_t i = 0; i < kBlockSize; ++i) {
    if (!(block.x[i] < kInfinity)) continue;
    const Vec3d p(Vec3{block.x[i], block.y[i], block.z[i]} - first);
    sum = sum + p;
    sum2 += dot(p, p);
    ++count;
  }
  if (count < 2) return 0;
  const double variance = (sum2 - dot(sum, sum) / count) / (count - 1);
  return static_cast<float>(3 * 2 * variance / count);
}

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
  max_reach2_ = share * share * bandwidth.max_radius * bandwidth.max_radius;
  const std::uint32_t blocks = tree_.slots() / kBlockSize;
  for (std::uint32_t b = 0; b < blocks; ++b) {
    const float disc = area_per_site(tree_.block(b)) * static_cast<float>(neighbours);
    reach2_.push_back(std::min(max_reach2_, share * share * disc * kInvPi));
  }
}

std::optional<std::uint32_t> RecordSites::find(const PhotonQuery& query,
                                               Vec3 shading_normal) const {
  std::uint32_t best = kNone;
  float limit = max_reach2_;
  PhotonTreeWalk walk(tree_, query.position, facing_near(query.normal));
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(limit);
    if (b == kNone) break;
    const BlockDistances block(tree_.block(b), query);
    for (std::uint32_t near = block.nearer_than(limit); near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      const std::uint32_t site = b * kBlockSize + lane;
      if (!(block.distance2[lane] < limit)) continue;
      if (!(dot(sites_[site].ng, query.normal) > kMinCosine)) continue;
      if (!(dot(sites_[site].ns, shading_normal) > kMinCosine)) continue;
      limit = block.distance2[lane];
      best = site;
    }
  }
  if (best == kNone || !(limit < reach2_[best / kBlockSize])) return std::nullopt;
  return best;
}

float RecordSites::reach(std::uint32_t record) const {
  return std::sqrt(reach2_[record / kBlockSize]);
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
