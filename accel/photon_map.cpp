// Building a PhotonMap and looking photons up in it.
//
// k nearest by selection instead of a heap: candidates are appended while they are closer than the
// limit; when the list is full, nth_element cuts it to the k best and the limit shrinks to the last
// of them. That costs O(1) per candidate. Ties are decided by the photon's index in the map.
#include "accel/photon_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "accel/photon_filter.h"
#include "core/check.h"
#include "core/parallel.h"

namespace octolux {
namespace {

constexpr std::int64_t kChunk = 16384;

bool is_usable(const Photon& p) {
  return is_finite(p.position) && is_finite(p.wi) && is_finite(p.normal) && is_finite(p.flux) &&
         p.flux.r >= 0 && p.flux.g >= 0 && p.flux.b >= 0;
}

std::vector<PhotonTree::Item> usable_items(const std::vector<Photon>& photons) {
  const auto count = static_cast<std::int64_t>(photons.size());
  std::vector<std::size_t> start(static_cast<std::size_t>((count + kChunk - 1) / kChunk) + 1, 0);
  parallel_for_chunks(count, kChunk, [&](std::int64_t c, std::int64_t begin, std::int64_t end) {
    start[c + 1] = static_cast<std::size_t>(
        std::count_if(photons.begin() + begin, photons.begin() + end, is_usable));
  });
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  std::vector<PhotonTree::Item> items(start.back());
  parallel_for_chunks(count, kChunk, [&](std::int64_t c, std::int64_t begin, std::int64_t end) {
    std::size_t next = start[c];
    for (std::int64_t i = begin; i < end; ++i) {
      if (!is_usable(photons[i])) continue;
      items[next++] = {photons[i].position, static_cast<std::uint32_t>(i)};
    }
  });
  return items;
}

/// Squared distances of a block's photons, in the squashed metric.
struct BlockDistances {
  alignas(64) float distance2[PhotonTree::kBlockSize];

  BlockDistances(const PhotonTree::Block& block, const PhotonQuery& query, float squash) {
    const Vec3 p = query.position;
    const Vec3 n = query.normal;
    for (std::uint32_t i = 0; i < PhotonTree::kBlockSize; ++i) {
      const float dx = block.x[i] - p.x;
      const float dy = block.y[i] - p.y;
      const float dz = block.z[i] - p.z;
      const float along = dx * n.x + dy * n.y + dz * n.z;
      distance2[i] = dx * dx + dy * dy + dz * dz + squash * (along * along);
    }
  }
};

/// Where a look-up may find photons. Decided at compile time, so a look-up without a region pays
/// nothing for those with one.
struct Anywhere {
  bool contains(Vec3) const { return true; }
};
struct Inside {
  const PhotonRegion& region;
  Vec3 position;
  bool contains(Vec3 photon) const { return region.contains(photon - position); }
};

float squash_factor(const PhotonQuery& query) {
  OCTOLUX_CHECK(query.squash >= 1);
  return query.squash * query.squash - 1;
}

/// Keeps the k best of `count` candidates, the farthest last.
void keep_best(Neighbour* items, std::size_t k, std::size_t count) {
  std::nth_element(items, items + k - 1, items + count);
}

}  // namespace

PhotonMap::PhotonMap(std::vector<Photon> photons) {
  OCTOLUX_CHECK(photons.size() < (std::uint64_t{1} << 32));
  std::vector<PhotonTree::Item> items = usable_items(photons);
  rejected_ = photons.size() - items.size();
  tree_ = PhotonTree(items);
  payloads_.resize(items.size());
  const auto count = static_cast<std::int64_t>(items.size());
  parallel_for_chunks(count, kChunk, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) payloads_[i] = pack(photons[items[i].index]);
  });
}

std::size_t PhotonMap::memory() const {
  return sizeof(*this) + tree_.memory() + payloads_.capacity() * sizeof(PhotonPayload);
}

std::span<const Neighbour> PhotonMap::nearest(const PhotonQuery& query, std::size_t k,
                                              NeighbourBuffer& buffer) const {
  if (query.region == nullptr) return nearest_in(Anywhere{}, query, k, buffer);
  return nearest_in(Inside{*query.region, query.position}, query, k, buffer);
}

std::span<const Neighbour> PhotonMap::within(const PhotonQuery& query,
                                             NeighbourBuffer& buffer) const {
  if (query.region == nullptr) return within_in(Anywhere{}, query, buffer);
  return within_in(Inside{*query.region, query.position}, query, buffer);
}

float PhotonMap::rough_distance(Vec3 position, std::size_t k) const {
  PhotonTreeWalk walk(tree_, position);
  const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(kInfinity);
  if (b == PhotonTreeWalk::kEnd) return kInfinity;
  float sum = 0;
  float count = 0;
  for (std::uint32_t lane = 0; lane < PhotonTree::kBlockSize; ++lane) {
    const float d2 = length2(tree_.position(b * PhotonTree::kBlockSize + lane) - position);
    if (!(d2 < kInfinity)) continue;
    sum += d2;
    ++count;
  }
  // Two random points of a square leaf are at a mean squared distance of a third of its area.
  const float area = 3 * sum / count;
  return std::sqrt(area * (static_cast<float>(k) / count) * kInvPi);
}

template <class Region>
std::span<const Neighbour> PhotonMap::nearest_in(Region region, const PhotonQuery& query,
                                                 std::size_t k, NeighbourBuffer& buffer) const {
  k = std::min(k, size());
  if (k == 0) return {};
  const std::size_t full = 2 * k + PhotonTree::kBlockSize;
  if (buffer.items.size() < full + PhotonTree::kBlockSize) {
    buffer.items.resize(full + PhotonTree::kBlockSize);
  }
  Neighbour* items = buffer.items.data();
  const float squash = squash_factor(query);
  PhotonFilter counts(query);
  PhotonTreeWalk walk(tree_, query.position);
  float limit = query.max_radius * query.max_radius;
  std::size_t count = 0;
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(limit);
    if (b == PhotonTreeWalk::kEnd) break;
    const BlockDistances block(tree_.block(b), query, squash);
    for (std::uint32_t lane = 0; lane < PhotonTree::kBlockSize; ++lane) {
      const std::uint32_t photon = b * PhotonTree::kBlockSize + lane;
      if (!(block.distance2[lane] < limit) || !counts(payloads_[photon]) ||
          !region.contains(tree_.position(photon))) {
        continue;
      }
      items[count++] = {block.distance2[lane], photon};
    }
    if (count >= full) {
      keep_best(items, k, count);
      count = k;
      limit = std::nextafter(items[k - 1].distance2, kInfinity);
    }
  }
  if (count > k) keep_best(items, k, count);
  count = std::min(count, k);
  if (count > 0) std::iter_swap(items + count - 1, std::max_element(items, items + count));
  return {items, count};
}

template <class Region>
std::span<const Neighbour> PhotonMap::within_in(Region region, const PhotonQuery& query,
                                                NeighbourBuffer& buffer) const {
  const float squash = squash_factor(query);
  const float limit = query.max_radius * query.max_radius;
  PhotonFilter counts(query);
  PhotonTreeWalk walk(tree_, query.position);
  buffer.items.clear();
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::left_to_right>(limit);
    if (b == PhotonTreeWalk::kEnd) break;
    const BlockDistances block(tree_.block(b), query, squash);
    for (std::uint32_t lane = 0; lane < PhotonTree::kBlockSize; ++lane) {
      const std::uint32_t photon = b * PhotonTree::kBlockSize + lane;
      if (!(block.distance2[lane] < limit) || !counts(payloads_[photon]) ||
          !region.contains(tree_.position(photon))) {
        continue;
      }
      buffer.items.push_back({block.distance2[lane], photon});
    }
  }
  return buffer.items;
}

}  // namespace octolux
