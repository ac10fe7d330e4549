// A choice among finite lights that knows the point to be lit: a binary tree of light bounds,
// walked from the root, at every node to the child that seems to bring more light there (Conty
// Estevez & Kulla, HPG 2018; Pharr, Jakob & Humphreys, "Physically Based Rendering", 4th ed.,
// 12.6.3). What cannot reach the point, because it shines elsewhere or lies behind the surface, is
// never chosen while there is anything else.
//
// Occlusion is not known, but foreseen: indoors most lights are in other rooms, the more so the
// farther away. Variance is least if each light is chosen in proportion to what it would bring,
// times the root of the probability that it is seen. So importance falls with the cube of the
// distance, not the square; lights count by the root of their power; and a part of the probability
// at each node knows weights only. In three rooms of a house this leaves a half to a fifth of the
// variance that plain irradiance does, and in one open room costs a fifth.
//
// Whoever knows more than that chooses a group of lights by himself (light_sampler.h): a subtree
// some levels below the root.
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
  Vec3 normal;                          // unit, on the side that scatters towards the viewer
  bool both_sides = false;              // may light from behind be scattered to the viewer, too?
  std::span<const float> learned = {};  // chances of LightSampler's groups (learned_lights.h)
};

class LightTree {
 public:
  LightTree() = default;
  /// Weights must be positive and finite.
  explicit LightTree(std::span<const LightBounds> lights);

  struct Choice {
    int light = -1;  // index into the constructor's list; -1: there are none
    int group = -1;
    float pmf_of_group = 0, pmf_in_group = 0;
    float pmf() const { return pmf_of_group * pmf_in_group; }
  };
  /// `u` uniform in [0, 1).
  Choice sample(const Receiver& at, float u) const;
  /// As `sample` chooses where it chooses that group.
  Choice sample_in(const Receiver& at, int group, float u) const;
  /// The choice of `light`, with the probabilities with which `sample` makes it; those of all
  /// lights sum to 1 at every point.
  Choice choice(const Receiver& at, int light) const;

  int groups() const { return static_cast<int>(roots_.size()); }
  bool empty() const { return nodes_.empty(); }

 private:
  /// The two children of a node stand side by side, the first at an odd index.
  struct Node {
    Vec3 center;       // of the bounding box
    Vec3 half;         // [m] its extent to either side
    float radius = 0;  // [m] of the sphere around it
    Vec3 axis;         // of the cone of normals
    float cos_normals = -1, sin_normals = 0;
    float cos_emission = 0;
    float intensity = 0;  // [sr^-1], along the axis: share of all weight, per solid angle
    float part = 0;       // of its parent's weight, if it is a first child
    int child = -1;       // the first one; or -1 - light
    int parent = -1;
    int group = -1;  // that it is the root or a part of
  };
  class Builder;

  Choice descend(const Receiver& at, float u, int index) const;
  float share(const Receiver& at, int index) const;
  float first_share(const Receiver& at, int first) const;
  float importance(const Node& node, const Receiver& at) const;
  static float emission(const Node& node, Vec3 wi, float sin_seen);

  std::vector<Node> nodes_;  // the root first
  std::vector<int> leaf_;    // per light
  std::vector<int> roots_;   // per group
  float unit_ = 1;           // [m] extent of all lights
};

}  // namespace octolux
