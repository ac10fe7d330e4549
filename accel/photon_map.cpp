// Building a PhotonMap and looking photons up in it.
//
// k nearest by selection instead of a heap: candidates are appended while they are closer than the
// limit; when the list is full, it is cut to the k best and the limit shrinks to the last of them.
// That costs O(1) per candidate. The cut looks for a distance with k candidates below it by
// interpolation (squared distances of photons on a surface are uniform), because counting has no
// branches to mispredict, unlike nth_element; ties, decided by the index, are left to that.
#include "accel/photon_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "accel/block_distances.h"
#include "accel/photon_filter.h"
#include "accel/photon_tree_walk.h"
#include "core/check.h"
#include "core/parallel.h"

namespace octolux {
namespace {

constexpr std::int64_t kChunk = 16384;
constexpr int kSelectionSteps = 10;

/// The usable photons in their given order, for the tree to sort. Payloads are packed before they
/// are put into the tree's order, because they are half as long then.
struct Usable {
  std::vector<PhotonTree::Item> items;
  std::vector<PhotonPayload> payloads;
  std::vector<FacingSet> facing;

  explicit Usable(std::span<const Photon> photons) {
    const auto count = static_cast<std::int64_t>(photons.size());
    std::vector<std::size_t> start(static_cast<std::size_t>((count + kChunk - 1) / kChunk) + 1, 0);
    parallel_for_chunks(count, kChunk, [&](std::int64_t c, std::int64_t begin, std::int64_t end) {
      start[c + 1] = static_cast<std::size_t>(
          std::count_if(photons.begin() + begin, photons.begin() + end, is_usable));
    });
    for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
    items.resize(start.back());
    payloads.resize(start.back());
    facing.resize(start.back());
    parallel_for_chunks(count, kChunk, [&](std::int64_t c, std::int64_t begin, std::int64_t end) {
      std::size_t next = start[c];
      for (std::int64_t i = begin; i < end; ++i) {
        if (!is_usable(photons[i])) continue;
        payloads[next] = pack(photons[i]);
        facing[next] = octolux::facing(normal(payloads[next]));
        items[next] = {photons[i].position, static_cast<std::uint32_t>(next)};
        ++next;
      }
    });
  }
};

/// Where a look-up may find photons. Decided at compile time, so a look-up without a region pays
/// nothing for those with one.
struct Anywhere {
  bool contains(Vec3, float) const { return true; }
};
struct Inside {
  const PhotonRegion& region;
  Vec3 position;
  bool contains(Vec3 photon, float distance2) const {
    return distance2 < region.clearance * region.clearance || region.contains(photon - position);
  }
};

FacingSet wanted_facing(const PhotonQuery& query) {
  const FacingSet front = facing_near(query.normal);
  return query.both_sides ? front | facing_near(-query.normal) : front;
}

std::size_t count_below(const Neighbour* items, std::size_t count, float limit) {
  std::size_t below = 0;
  for (std::size_t i = 0; i < count; ++i) below += items[i].distance2 < limit ? 1 : 0;
  return below;
}

float largest_distance2(const Neighbour* items, std::size_t count) {
  std::uint32_t bits = 0;  // floats that are not negative compare as their bits do
  for (std::size_t i = 0; i < count; ++i) {
    bits = std::max(bits, std::bit_cast<std::uint32_t>(items[i].distance2));
  }
  return std::bit_cast<float>(bits);
}

/// Moves the items below `limit` to the front, without a branch.
void keep_below(Neighbour* items, std::size_t count, float limit) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Neighbour item = items[i];
    items[kept] = item;
    kept += item.distance2 < limit ? 1 : 0;
  }
}

/// Moves the k best of `count` > k candidates to the front. Returns a limit they are all below, and
/// no photon that is among the k best of all is at or above it.
float keep_best(Neighbour* items, std::size_t k, std::size_t count) {
  float low = 0, high = std::nextafter(largest_distance2(items, count), kInfinity);
  std::size_t below_low = 0, below_high = count;
  for (int i = 0; i < kSelectionSteps && below_high > k; ++i) {
    const float part =
        (static_cast<float>(k - below_low) + 0.5f) / static_cast<float>(below_high - below_low);
    const float middle = low + (high - low) * std::min(part, 0.99f);
    const std::size_t below = count_below(items, count, middle);
    (below < k ? low : high) = middle;
    (below < k ? below_low : below_high) = below;
  }
  keep_below(items, count, high);
  if (below_high > k) {
    std::nth_element(items, items + k - 1, items + below_high);
    high = std::nextafter(items[k - 1].distance2, kInfinity);
  }
  return high;
}

/// Around a position, as far as a leaf tells.
float photons_per_area(const PhotonTree::Block& block, Vec3 position) {
  constexpr std::uint32_t kLanes = 8;  // sums for SIMD
  float sums[kLanes] = {}, counts[kLanes] = {};
  for (std::uint32_t first = 0; first < PhotonTree::kBlockSize; first += kLanes) {
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      const float dx = block.x[first + i] - position.x;
      const float dy = block.y[first + i] - position.y;
      const float dz = block.z[first + i] - position.z;
      const float d2 = dx * dx + dy * dy + dz * dz;
      sums[i] += d2 < kInfinity ? d2 : 0;
      counts[i] += d2 < kInfinity ? 1.0f : 0.0f;
    }
  }
  const float sum = std::accumulate(sums, sums + kLanes, 0.0f);
  const float count = std::accumulate(counts, counts + kLanes, 0.0f);
  // Two random points of a square leaf are at a mean squared distance of a third of its area.
  const float area = 3 * sum / count;
  return count / area;
}

}  // namespace

PhotonMap::PhotonMap(std::vector<Photon> photons) {
  OCTOLUX_CHECK(photons.size() < (std::uint64_t{1} << 32));
  Usable usable(photons);
  rejected_ = photons.size() - usable.items.size();
  photons = std::vector<Photon>();  // `= {}` would keep the memory
  size_ = usable.items.size();
  tree_ = PhotonTree(usable.items, usable.facing);
  payloads_.resize(tree_.slots());
  parallel_for_chunks(slots(), kChunk, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const std::uint32_t index = usable.items[i].index;
      if (index != PhotonTree::kNone) payloads_[i] = usable.payloads[index];
    }
  });
}

std::size_t PhotonMap::memory() const {
  return sizeof(*this) + tree_.memory() + payloads_.capacity() * sizeof(PhotonPayload);
}

std::span<const Neighbour> PhotonMap::nearest(const PhotonQuery& query, std::size_t k,
                                              NeighbourBuffer& buffer) const {
  OCTOLUX_CHECK(query.squash >= 1);
  if (query.region == nullptr) return nearest_in(Anywhere{}, query, k, buffer);
  return nearest_in(Inside{*query.region, query.position}, query, k, buffer);
}

std::span<const Neighbour> PhotonMap::within(const PhotonQuery& query,
                                             NeighbourBuffer& buffer) const {
  OCTOLUX_CHECK(query.squash >= 1);
  if (query.region == nullptr) return within_in(Anywhere{}, query, buffer);
  return within_in(Inside{*query.region, query.position}, query, buffer);
}

float PhotonMap::rough_distance(Vec3 position, Vec3 normal, std::size_t k) const {
  float per_area = 0;
  tree_.blocks_at(position, facing_near(normal), [&](const PhotonTree::Block& block) {
    per_area += photons_per_area(block, position);
  });
  return std::sqrt(static_cast<float>(k) / per_area * kInvPi);
}

template <class Region>
std::span<const Neighbour> PhotonMap::nearest_in(Region region, const PhotonQuery& query,
                                                 std::size_t k, NeighbourBuffer& buffer) const {
  k = std::min(k, size());
  if (k == 0) return {};
  const std::size_t full = k + k / 2 + PhotonTree::kBlockSize;
  if (buffer.items.size() < full + PhotonTree::kBlockSize) {
    buffer.items.resize(full + PhotonTree::kBlockSize);
  }
  Neighbour* items = buffer.items.data();
  PhotonFilter counts(query);
  PhotonTreeWalk walk(tree_, query.position, wanted_facing(query));
  float limit = query.max_radius * query.max_radius;
  std::size_t count = 0;
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::nearest_first>(limit);
    if (b == PhotonTreeWalk::kEnd) break;
    const BlockDistances block(tree_.block(b), query);
    for (std::uint32_t near = block.nearer_than(limit); near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      const std::uint32_t photon = b * PhotonTree::kBlockSize + lane;
      const float distance2 = block.distance2[lane];
      if (!counts(payloads_[photon]) || !region.contains(tree_.position(photon), distance2)) {
        continue;
      }
      items[count++] = {distance2, photon};
    }
    if (count >= full) {
      limit = keep_best(items, k, count);
      count = k;
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
  const float limit = query.max_radius * query.max_radius;
  PhotonFilter counts(query);
  PhotonTreeWalk walk(tree_, query.position, wanted_facing(query));
  buffer.items.clear();
  for (;;) {
    const std::uint32_t b = walk.next<PhotonTreeWalk::Order::left_to_right>(limit);
    if (b == PhotonTreeWalk::kEnd) break;
    const BlockDistances block(tree_.block(b), query);
    for (std::uint32_t near = block.nearer_than(limit); near != 0; near &= near - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
      const std::uint32_t photon = b * PhotonTree::kBlockSize + lane;
      const float distance2 = block.distance2[lane];
      if (!counts(payloads_[photon]) || !region.contains(tree_.position(photon), distance2)) {
        continue;
      }
      buffer.items.push_back({distance2, photon});
    }
  }
  return buffer.items;
}

}  // namespace octolux
