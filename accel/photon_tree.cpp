// Building the kd-tree: medians by nth_element (Musser's introselect), halves in parallel.
#include "accel/photon_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

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

PhotonTree::PhotonTree(std::vector<Item>& items, std::span<const FacingSet> facing) {
  OCTOLUX_CHECK(items.size() <= kMaxItems);
  group(items, facing);
  if (roots_.empty()) return;
  build(items, roots_);
  fill_blocks(items);
}

std::size_t PhotonTree::memory() const {
  return roots_.capacity() * sizeof(Root) + blocks_.capacity() * sizeof(Block) +
         nodes_.capacity() * sizeof(Node);
}

/// Makes the roots, and sorts the items by them.
void PhotonTree::group(std::vector<Item>& items, std::span<const FacingSet> facing) {
  const auto way = [&](const Item& item) { return std::countr_zero(facing[item.index]); };
  std::array<std::uint32_t, kFacings> counts{};
  for (const Item& item : items) ++counts[way(item)];
  std::array<std::size_t, kFacings> next{};  // slot
  std::uint32_t blocks = 0;
  for (std::size_t f = 0; f < kFacings; ++f) {
    if (counts[f] == 0) continue;
    next[f] = std::size_t{blocks} * kBlockSize;
    const std::uint32_t leaves = (counts[f] + kBlockSize - 1) / kBlockSize;
    roots_.push_back(
        {FacingSet{1} << f, counts[f], blocks, leaves, std::bit_floor(2 * leaves - 1)});
    blocks += leaves;
  }
  std::vector<Item> grouped(std::size_t{blocks} * kBlockSize);
  for (const Item& item : items) grouped[next[way(item)]++] = item;
  items = std::move(grouped);
  nodes_.resize(blocks);
  blocks_.resize(blocks);
}

void PhotonTree::build(std::span<Item> items, std::span<Root> roots) {
  const std::size_t half = roots.size() / 2;
  if (half > 0) {
    parallel_invoke([&] { build(items, roots.first(half)); },
                    [&] { build(items, roots.subspan(half)); });
    return;
  }
  Root& root = roots[0];
  const std::span<Item> own = root.of(items);
  root.lower = root.upper = own[0].position;
  for (const Item& item : own) {
    root.lower = min(root.lower, item.position);
    root.upper = max(root.upper, item.position);
  }
  split(own, root, 1, root.leaves);
}

void PhotonTree::split(std::span<Item> items, const Root& root, std::uint32_t node,
                       std::uint32_t leaves) {
  if (leaves < 2) return;
  const std::uint32_t left = left_leaves(leaves);
  const std::size_t count = std::size_t{left} * kBlockSize;
  const std::uint32_t axis = widest_axis(items);
  const float plane = axis == 0   ? select<&Vec3::x>(items, count)
                      : axis == 1 ? select<&Vec3::y>(items, count)
                                  : select<&Vec3::z>(items, count);
  nodes_[root.first + node] = {plane, axis};
  const auto split_left = [&] { split(items.first(count), root, 2 * node, left); };
  const auto split_right = [&] { split(items.subspan(count), root, 2 * node + 1, leaves - left); };
  if (items.size() > kParallelItems) {
    parallel_invoke(split_left, split_right);
  } else {
    split_left();
    split_right();
  }
}

void PhotonTree::fill_blocks(std::span<const Item> items) {
  const auto count = static_cast<std::int64_t>(blocks_.size());
  parallel_for_chunks(count, 1024, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      for (std::uint32_t lane = 0; lane < kBlockSize; ++lane) {
        const Vec3 p = items[static_cast<std::size_t>(b) * kBlockSize + lane].position;
        blocks_[b].x[lane] = p.x;
        blocks_[b].y[lane] = p.y;
        blocks_[b].z[lane] = p.z;
      }
    }
  });
}

std::uint32_t PhotonTree::block_at(const Root& root, Vec3 position) const {
  std::uint32_t node = 1;
  while (node < root.leaves) {
    const Node& n = nodes_[root.first + node];
    node = 2 * node + (position[static_cast<int>(n.axis)] >= n.split ? 1 : 0);
  }
  return root.block_of(node);
}

}  // namespace octolux
