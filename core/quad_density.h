// A piecewise constant density over the unit square, fine where its samples are: a quadtree of
// squares that hold few of them (after Mueller, Gross & Novak, "Practical Path Guiding for
// Efficient Light-Transport Simulation", EGSR 2017, section 3.2).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace octolux {

/// Immutable. Uniform if made from nothing.
class QuadDensity {
 public:
  struct Point {
    Vec2 u;          // in [0, 1)^2
    float mass = 0;  // >= 0, finite
  };

  QuadDensity() = default;
  static constexpr std::size_t kMostPoints = 4096;
  /// Squares that hold `fewest` (at least 2) points or more are cut in four, down to a side of
  /// 1/1024. Sorts the points, at most kMostPoints.
  QuadDensity(std::span<Point> points, std::size_t fewest);

  /// At `u` in [0, 1)^2; its integral is 1.
  float operator()(Vec2 u) const;
  /// A point of this density from a uniform one. Neighbours stay near, so even points stay even.
  Vec2 sample(Vec2 u) const;

 private:
  /// Four quadrants: 0 lower left, 1 lower right, 2 upper left, 3 upper right.
  struct Node {
    std::array<float, 4> share{};          // of the node's mass; all sum to 1
    std::array<std::uint16_t, 4> child{};  // 0: not cut further
  };
  struct Square {
    Vec2 corner;
    float size = 1;
  };
  std::uint16_t build(std::span<Point> points, Square square, float mass, std::size_t fewest);

  std::vector<Node> nodes_;  // the first is the root
};

}  // namespace octolux
