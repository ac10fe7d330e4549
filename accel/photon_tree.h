// The kd-tree under a PhotonMap: positions only.
//
// Leaves hold kBlockSize photons as a structure of arrays, for SIMD. The tree over them is complete
// and implicit, as a binary heap: node i has the children 2 i and 2 i + 1; with m leaves, nodes 1
// to m - 1 are inner and m to 2 m - 1 are leaves. All blocks are full except the last one. 12 bytes
// a photon and one for the tree. Queries measure cells as in Arya & Mount, "Algorithms for
// Fast Vector Quantization" (DCC 1993): a cell's distance grows by one offset per split plane.
// Each node knows which ways the surfaces of its photons face (accel/facing.h).
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
    FacingSet facing = 0;    // of the photons below
  };
  struct Item {
    Vec3 position;
    std::uint32_t index = 0;  // of the caller
  };

  static constexpr std::size_t kMaxItems = (1u << 29) - kBlockSize;  // coordinate_offset < 2^31
  static constexpr double kBytesPerItem =
      double{sizeof(Block) + sizeof(Node) + sizeof(FacingSet)} / kBlockSize;

  PhotonTree() = default;
  /// Sorts `items` into the tree's order: item i is lane i % kBlockSize of block i / kBlockSize.
  /// Positions must be finite. `facing` is by the caller's index.
  PhotonTree(std::span<Item> items, std::span<const FacingSet> facing);

  const Block& block(std::uint32_t index) const { return blocks_[index]; }
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
  /// The block around a position; there must be one.
  std::uint32_t leaf_at(Vec3 position) const;
  std::size_t memory() const;

 private:
  friend class PhotonTreeWalk;
  std::uint32_t leaf_count() const { return static_cast<std::uint32_t>(blocks_.size()); }
  /// Block of leaf `node`: the heap's last level comes first from left to right.
  std::uint32_t block_of(std::uint32_t node) const {
    return node - last_level_ + (node < last_level_ ? leaf_count() : 0);
  }
  void split(std::span<Item> items, std::uint32_t node, std::uint32_t leaves);
  void fill_blocks(std::span<const Item> items, std::span<const FacingSet> facing);
  FacingSet facing_of(std::uint32_t node) const {
    return node < leaf_count() ? nodes_[node].facing : block_facing_[block_of(node)];
  }

  std::vector<Node> nodes_;  // [0] is unused
  std::vector<Block> blocks_;
  std::vector<FacingSet> block_facing_;
  std::uint32_t last_level_ = 0;  // first node of the heap's deepest level
};

/// Visits the blocks that may hold photons closer to `position` than a limit the caller may shrink
/// on the way. A distance is compared as the caller must compute it: dx dx + dy dy + dz dz in
/// float, from the left; rounding is monotonic, so no photon below the limit is ever missed.
class PhotonTreeWalk {
 public:
  enum class Order { nearest_first, left_to_right };
  static constexpr std::uint32_t kEnd = ~0u;
  /// Passes over branches with no photon on a surface that faces one of these ways.
  PhotonTreeWalk(const PhotonTree& tree, Vec3 position, FacingSet facing)
      : tree_(tree), position_{position.x, position.y, position.z}, facing_(facing) {
    if (tree.leaf_count() > 0) stack_[size_++] = {1, 0, {0, 0, 0}};
  }

  /// The next block with a part at a squared distance below `limit`, or kEnd.
  template <Order order>
  std::uint32_t next(float limit) {
    while (size_ > 0) {
      Cell cell = stack_[--size_];
      if (!(cell.distance2 < limit)) continue;
      while (cell.node < tree_.leaf_count() && (tree_.nodes_[cell.node].facing & facing_) != 0) {
        descend<order>(cell, limit);
      }
      if (cell.node < tree_.leaf_count() || !(cell.distance2 < limit)) continue;
      const std::uint32_t block = tree_.block_of(cell.node);
      if ((tree_.block_facing_[block] & facing_) != 0) return block;
    }
    return kEnd;
  }

 private:
  struct Cell {
    std::uint32_t node;
    float distance2;
    std::array<float, 3> offset;  // per axis, from the position to the cell
  };
  /// Fewer than 2^32 photons make fewer than 2^28 leaves, so a path has fewer than 29 inner nodes.
  static constexpr int kStackSize = 32;

  /// Replaces `cell` by the child to visit first, and pushes the other one.
  template <Order order>
  void descend(Cell& cell, float limit) {
    const PhotonTree::Node node = tree_.nodes_[cell.node];
    const float difference = position_[node.axis] - node.split;
    const std::uint32_t near = 2 * cell.node + (difference >= 0 ? 1 : 0);
    Cell far = cell;
    far.node = near ^ 1;
    far.offset[node.axis] = difference;
    far.distance2 = far.offset[0] * far.offset[0] + far.offset[1] * far.offset[1] +
                    far.offset[2] * far.offset[2];
    cell.node = near;
    if (order == Order::left_to_right && difference >= 0) std::swap(cell, far);
    if (far.distance2 < limit) stack_[size_++] = far;
  }

  const PhotonTree& tree_;
  std::array<float, 3> position_;
  FacingSet facing_;
  std::array<Cell, kStackSize> stack_;  // not initialised, except for what was pushed
  int size_ = 0;
};

}  // namespace octolux
