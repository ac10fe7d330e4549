// Building the kd-tree: medians by nth_element (Musser's introselect), halves in parallel.
#include "accel/photon_tree.h"

#include <algorithm>
#include <bit>

#include "core/check.h"
#include "core/parallel.h"

namespace octolux {
namespace {

constexpr std::size_t kParallelItems = 8192;  // below, a task costs more than it saves

std::uint32_t widest_axis(std::span<const PhotonTree::Item> items) {
  Vec3 lower = items[0].position;
  Vec3 upper = lower;
  for (const PhotonTree::Item& item : items) {
    lower = min(lower, item.position);
    upper = max(upper, item.position);
  }
  const Vec3 extent = upper - lower;
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

/// Moves the first `count` in the order (coordinate, index) to the front.
template <float Vec3::*axis>
float select(std::span<PhotonTree::Item> items, std::size_t count) {
  const auto middle = items.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(items.begin(), middle, items.end(), [](const auto& a, const auto& b) {
    const float p = a.position.*axis, q = b.position.*axis;
    return p < q || (p == q && a.index < b.index);
  });
  return middle->position.*axis;
}

/// Leaves of the left half of a complete tree with `leaves` of them.
std::uint32_t left_leaves(std::uint32_t leaves) {
  const std::uint32_t full = std::bit_floor(leaves);
  return full / 2 + std::min(leaves - full, full / 2);
}

}  // namespace

PhotonTree::PhotonTree(std::span<Item> items, std::span<const FacingSet> facing) {
  OCTOLUX_CHECK(items.size() <= kMaxItems);
  const std::size_t leaves = (items.size() + kBlockSize - 1) / kBlockSize;
  if (leaves == 0) return;
  nodes_.resize(leaves);
  blocks_.resize(leaves);
  block_facing_.resize(leaves);
  last_level_ = std::bit_floor(static_cast<std::uint32_t>(2 * leaves - 1));
  split(items, 1, leaf_count());
  fill_blocks(items, facing);
  for (std::uint32_t node = leaf_count() - 1; node > 0; --node) {
    nodes_[node].facing = facing_of(2 * node) | facing_of(2 * node + 1);
  }
}

std::uint32_t PhotonTree::leaf_at(Vec3 position) const {
  const std::array<float, 3> p{position.x, position.y, position.z};
  std::uint32_t node = 1;
  while (node < leaf_count()) node = 2 * node + (p[nodes_[node].axis] >= nodes_[node].split);
  return block_of(node);
}

std::size_t PhotonTree::memory() const {
  return blocks_.capacity() * sizeof(Block) + nodes_.capacity() * sizeof(Node) +
         block_facing_.capacity() * sizeof(FacingSet);
}

void PhotonTree::split(std::span<Item> items, std::uint32_t node, std::uint32_t leaves) {
  if (leaves < 2) return;
  const std::uint32_t left = left_leaves(leaves);
  const std::size_t count = std::size_t{left} * kBlockSize;
  const std::uint32_t axis = widest_axis(items);
  const float plane = axis == 0   ? select<&Vec3::x>(items, count)
                      : axis == 1 ? select<&Vec3::y>(items, count)
                                  : select<&Vec3::z>(items, count);
  nodes_[node].split = plane;
  nodes_[node].axis = axis;
  const auto split_left = [&] { split(items.first(count), 2 * node, left); };
  const auto split_right = [&] { split(items.subspan(count), 2 * node + 1, leaves - left); };
  if (items.size() > kParallelItems) {
    parallel_invoke(split_left, split_right);
  } else {
    split_left();
    split_right();
  }
}

void PhotonTree::fill_blocks(std::span<const Item> items, std::span<const FacingSet> facing) {
  parallel_for_chunks(leaf_count(), 1024, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      for (std::uint32_t lane = 0; lane < kBlockSize; ++lane) {
        const std::size_t i = static_cast<std::size_t>(b) * kBlockSize + lane;
        const Vec3 p = i < items.size() ? items[i].position : Vec3{kInfinity, kInfinity, kInfinity};
        blocks_[b].x[lane] = p.x;
        blocks_[b].y[lane] = p.y;
        blocks_[b].z[lane] = p.z;
        if (i < items.size()) block_facing_[b] |= facing[items[i].index];
      }
    }
  });
}

}  // namespace octolux
