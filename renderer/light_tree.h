// A choice among finite lights that knows the point to be lit: a binary tree of light bounds,
// walked from the root, at every node to the child that seems to bring more light there (Conty
// Estevez & Kulla, HPG 2018; Pharr, Jakob & Humphreys, "Physically Based Rendering", 4th ed.,
// 12.6.3). Occlusion is not known. What cannot reach the point, because it shines elsewhere or is
// behind the surface, is not chosen; of everything else no child gets less than kLeastShare, so
// that what is unseen at a node cannot make a light's samples arbitrarily rare and heavy.
//
// O(log n) for choosing and for the probability; no allocation. The walk inverts a cumulative sum
// over the leaves, so strata of u stay together. Built deterministically. Immutable once built, so
// thread-safe.
#pragma once

#include <span>
#include <vector>

#include "renderer/light_bounds.h"

namespace octolux {

/// A point where light is wanted, as far as choosing a light looks at it.
struct Receiver {
  Vec3 position;
  Vec3 normal;              // unit, on the side that scatters towards the viewer
  bool both_sides = false;  // may light from behind be scattered to the viewer, too?
};

class LightTree {
 public:
  LightTree() = default;
  /// Powers must be positive and finite.
  explicit LightTree(std::span<const LightBounds> lights);

  struct Choice {
    int light = -1;  // index into the constructor's list; -1: there are none
    float pmf = 0;
  };
  /// `u` uniform in [0, 1).
  Choice sample(const Receiver& at, float u) const;
  /// Probability that `sample` chooses `light`. Sums to 1 over all lights at every point.
  float pmf(const Receiver& at, int light) const;

  bool empty() const { return nodes_.empty(); }

 private:
  /// The two children of a node stand side by side, the first at an odd index.
  struct Node {
    Vec3 center;       // of the bounding sphere
    float radius = 0;  // [m]
    Vec3 axis;         // of the cone of normals
    float cos_normals = -1, sin_normals = 0;
    float cos_emission = 0;
    float intensity = 0;  // [sr^-1], along the axis, per watt of all lights
    int child = -1;       // the first one; or -1 - light
    int parent = -1;
  };
  class Builder;

  float first_share(const Receiver& at, int first) const;
  static float importance(const Node& node, const Receiver& at);

  std::vector<Node> nodes_;  // the root first
  std::vector<int> leaf_;    // per light
};

}  // namespace octolux
