// The kd-trees under a PhotonMap: positions only, one tree for each way surfaces face
// (accel/facing.h). Photons on the two sides of a wall, or where walls meet, are as near to each
// other as those of one side, but a look-up counts one side only; in a common tree most of what it
// would try could not count.
//
// Leaves hold kBlockSize photons as a structure of arrays, for SIMD. A tree over them is complete
// and implicit, as a binary heap: node i has the children 2 i and 2 i + 1; with m leaves, nodes 1
// to m - 1 are inner and m to 2 m - 1 are leaves. All blocks of a tree are full except the last
// one. 12 bytes a photon and half a one for the tree.
//
// Immutable after construction, so thread-safe; the same for every number of threads, because
// splits follow a total order (coordinate, then index).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/facing.h"
#include "core/constants.h"
#include "core/vec.h"

namespace octolux {

class PhotonTree {
 public:
  static constexpr std::uint32_t kBlockSize = 16;

  /// Positions of a leaf; lanes without a photon are at infinity.
  struct alignas(64) Block {
    float x[kBlockSize], y[kBlockSize], z[kBlockSize];
  };
  struct Node {
    float split = 0;         // left: coordinate <= split, right: coordinate >= split
    std::uint32_t axis = 0;  // 0, 1, 2
  };
  struct Item {
    Vec3 position{kInfinity, kInfinity, kInfinity};
    std::uint32_t index = kNone;  // of the caller
  };
  static constexpr std::uint32_t kNone = ~0u;

  static constexpr std::size_t kMaxItems = (1u << 29) - 1024;  // coordinate_offset below 2^31
  static constexpr double kBytesPerItem = double{sizeof(Block) + sizeof(Node)} / kBlockSize;

  PhotonTree() = default;
  /// Sorts `items` into the tree's order, with items of index kNone after each tree's last: item i
  /// is slot i, which is lane i % kBlockSize of block i / kBlockSize. Positions must be finite.
  /// `facing` is by the caller's index.
  PhotonTree(std::vector<Item>& items, std::span<const FacingSet> facing);

  std::uint32_t slots() const { return static_cast<std::uint32_t>(blocks_.size()) * kBlockSize; }
  const Block& block(std::uint32_t index) const { return blocks_[index]; }
  /// Of a slot; infinite if it holds nothing.
  Vec3 position(std::uint32_t photon) const {
    const Block& b = blocks_[photon / kBlockSize];
    const std::uint32_t lane = photon % kBlockSize;
    return {b.x[lane], b.y[lane], b.z[lane]};
  }
  /// x of a photon is at coordinate_offset(photon), below 2^31, y and z kBlockSize and twice that
  /// behind. Photons may be a vector of indices.
  const float* coordinates() const { return blocks_.empty() ? nullptr : blocks_[0].x; }
  template <class Photons>
  static Photons coordinate_offset(Photons photons) {
    return photons + 2 * (photons & ~static_cast<int>(kBlockSize - 1));
  }
  /// Calls `use` with the block around a position in each tree whose photons face one of these ways
  /// and surround it; if there is none, with that in the nearest tree whose photons do.
  template <class Use>
  void blocks_at(Vec3 position, FacingSet facing, const Use& use) const {
    const Root* nearest = nullptr;
    float nearest2 = kInfinity;
    for (const Root& root : roots_) {
      if ((root.facing & facing) == 0) continue;
      const float distance2 = root.distance2(position);
      if (distance2 == 0) use(blocks_[block_at(root, position)]);
      if (distance2 < nearest2) nearest = &root, nearest2 = distance2;
    }
    if (nearest2 > 0 && nearest) use(blocks_[block_at(*nearest, position)]);
  }
  std::size_t memory() const;

 private:
  friend class PhotonTreeWalk;

  /// The photons that face one way.
  struct Root {
    FacingSet facing = 0;
    std::uint32_t count = 0;       // photons
    std::uint32_t first = 0;       // of its blocks, and of its nodes (one of which is unused)
    std::uint32_t leaves = 0;      // at least 1
    std::uint32_t last_level = 0;  // first node of the heap's deepest level
    Vec3 lower{}, upper{};         // bounds

    std::span<Item> of(std::span<Item> items) const {
      return items.subspan(std::size_t{first} * kBlockSize, count);
    }
    /// Block of leaf `node`: the heap's last level comes first from left to right.
    std::uint32_t block_of(std::uint32_t node) const {
      return first + node - last_level + (node < last_level ? leaves : 0);
    }
    /// Per axis, from the position to the bounds.
    std::array<float, 3> offset(Vec3 position) const {
      const Vec3 o = max(max(lower - position, position - upper), Vec3{0, 0, 0});
      return {o.x, o.y, o.z};
    }
    float distance2(Vec3 position) const {
      const std::array<float, 3> o = offset(position);
      return o[0] * o[0] + o[1] * o[1] + o[2] * o[2];
    }
  };

  void group(std::vector<Item>& items, std::span<const FacingSet> facing);
  void build(std::span<Item> items, std::span<Root> roots);
  void split(std::span<Item> items, const Root& root, std::uint32_t node, std::uint32_t leaves);
  void fill_blocks(std::span<const Item> items);
  std::uint32_t block_at(const Root& root, Vec3 position) const;

  std::vector<Root> roots_;
  std::vector<Node> nodes_;
  std::vector<Block> blocks_;
};

}  // namespace octolux
