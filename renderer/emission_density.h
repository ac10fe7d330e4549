// Where photons are worth emitting. A photon's start is a point of the unit cube: one coordinate
// chooses the light by power, two the place on it and two the direction (LightSampler,
// Light::emit), so a uniform density over the cube is emission by power alone. This one is
// piecewise constant on the leaves of a tree of boxes and learned from trials: photons whose use to
// the picture is known (learn_emission.h).
//
// With m(x) = E[use | x], where use is the square of what the path contributes, N photons of
// density q have variance 1/N times the integral of m / q: least for q ~ sqrt(m), and then smaller
// than for uniform q by gain() = E[m] / E[sqrt m]^2. A split of a box is the one that lowers E[sqrt
// m] most (as in primary sample space guiding, Guo et al. 2018, with another measure). Boxes in
// which no trial was of use keep a share by the trials they had (m-estimates, Cestnik 1990), and a
// defensive share of all photons is uniform: no photon carries more than 1 / kDefensiveShare times
// the power it would carry without learning, and the picture stays right whatever was learned.
//
// Immutable, so thread-safe.
#pragma once

#include <array>
#include <vector>

#include "core/distribution.h"
#include "core/rng.h"

namespace octolux {

/// Coordinates in [0, 1): light, position x and y, direction x and y.
using EmissionPoint = std::array<float, 5>;

class EmissionDensity {
 public:
  static constexpr double kDefensiveShare = 0.5;

  struct Trial {
    EmissionPoint at{};
    double weight = 1;  // how many uniform trials it stands for; above 0
    double use = 0;     // not negative
  };

  /// Uniform.
  EmissionDensity() = default;
  /// Learned; uniform if no trial was of use.
  explicit EmissionDensity(std::vector<Trial> trials);

  bool uniform() const { return nodes_.empty(); }

  struct Sample {
    EmissionPoint at{};
    float weight = 1;  // 1 / density
  };
  /// `u` in [0, 1) chooses the box, and may be stratified over the photons of a pass.
  Sample sample(double u, Rng& rng) const;
  /// 1 on average over the cube.
  double density(const EmissionPoint& at) const;

  /// By how much fewer photons do as well as uniform ones; on the trials it was learned from, so
  /// optimistic. 1 if uniform.
  double gain() const { return gain_; }
  std::size_t boxes() const { return leaves_.size(); }

 private:
  struct Box {
    std::array<double, 5> lower{0, 0, 0, 0, 0}, upper{1, 1, 1, 1, 1};
    double volume() const;
  };
  struct Node {
    int axis = -1;     // of the split; -1: a leaf
    double split = 0;  // below it lies the next node
    int other = 0;     // node beyond the split; of a leaf its number
  };
  struct Leaf {
    Box box;
    double root_use = 0;  // sqrt m
    float weight = 1;     // 1 / density
  };
  class Builder;

  void set_weights();

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<double> cdf_;  // at the end of each leaf
  double gain_ = 1;
};

}  // namespace octolux
