// The way of a look-up through a PhotonTree. Queries measure cells as in Arya & Mount, "Algorithms
// for Fast Vector Quantization" (DCC 1993): a cell's distance grows by one offset per split plane.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "accel/photon_tree.h"

namespace octolux {

/// Visits the blocks that may hold photons closer to `position` than a limit the caller may shrink
/// on the way. A distance is compared as the caller must compute it: dx dx + dy dy + dz dz in
/// float, from the left; rounding is monotonic, so no photon below the limit is ever missed.
class PhotonTreeWalk {
 public:
  /// left_to_right: in the order of the blocks.
  enum class Order { nearest_first, left_to_right };
  static constexpr std::uint32_t kEnd = ~0u;

  /// Passes over photons on surfaces that face none of these ways.
  PhotonTreeWalk(const PhotonTree& tree, Vec3 position, FacingSet facing)
      : tree_(tree), position_(position), facing_(facing) {}

  /// The next block with a part at a squared distance below `limit`, or kEnd.
  template <Order order>
  std::uint32_t next(float limit) {
    do {
      while (size_ > 0) {
        Cell cell = stack_[--size_];
        if (!(cell.distance2 < limit)) continue;
        while (cell.node < root_->leaves) descend<order>(cell, limit);
        if (cell.distance2 < limit) return root_->block_of(cell.node);
      }
    } while (enter_tree<order>(limit));
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

  /// Goes on to the next tree below the limit: nearest_first to those around the position before
  /// all others.
  template <Order order>
  bool enter_tree(float limit) {
    constexpr bool nearest_first = order == Order::nearest_first;
    for (; outside_ < (nearest_first ? 2 : 1); ++outside_, next_root_ = 0) {
      while (next_root_ < tree_.roots_.size()) {
        root_ = &tree_.roots_[next_root_++];
        if ((root_->facing & facing_) == 0) continue;
        const float distance2 = root_->distance2(position_);
        if (nearest_first && (distance2 > 0) != (outside_ > 0)) continue;
        if (!(distance2 < limit)) continue;
        stack_[size_++] = {1, distance2, root_->offset(position_)};
        return true;
      }
    }
    return false;
  }

  /// Replaces `cell` by the child to visit first, and pushes the other one.
  template <Order order>
  void descend(Cell& cell, float limit) {
    const PhotonTree::Node node = tree_.nodes_[root_->first + cell.node];
    // Chosen by comparison: an index would send position and cell through memory at every node.
    const auto is = [&](std::uint32_t axis) { return node.axis == axis; };
    const float along = is(0) ? position_.x : is(1) ? position_.y : position_.z;
    const float difference = along - node.split;
    const std::uint32_t near = 2 * cell.node + (difference >= 0 ? 1 : 0);
    Cell far = cell;
    far.node = near ^ 1;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      if (is(axis)) far.offset[axis] = difference;
    }
    far.distance2 = far.offset[0] * far.offset[0] + far.offset[1] * far.offset[1] +
                    far.offset[2] * far.offset[2];
    cell.node = near;
    if (order == Order::left_to_right && difference >= 0) std::swap(cell, far);
    if (far.distance2 < limit) stack_[size_++] = far;
  }

  const PhotonTree& tree_;
  const PhotonTree::Root* root_ = nullptr;
  Vec3 position_;
  FacingSet facing_;
  std::size_t next_root_ = 0;
  int outside_ = 0;                     // 1: trees around the position are done
  std::array<Cell, kStackSize> stack_;  // not initialised, except for what was pushed
  int size_ = 0;
};

}  // namespace octolux
