// light_tree.h: building the tree.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "renderer/light_tree.h"

namespace octolux {

namespace {

constexpr float kMaxRadius = 1e18f;  // [m], whose square is a float
constexpr int kGroupDepth = 6;       // of a group's root, at most

/// Below this depth nodes are halved without looking, so that no arrangement of lights makes the
/// tree deep.
constexpr int kMaxHeuristicDepth = 64;

float coordinate(const LightBounds& light, int axis) { return light.extent.bounds.center()[axis]; }

}  // namespace

/// Top-down, 16 bins on each axis (their section 4.4, with LightBounds::cost).
class LightTree::Builder {
 public:
  Builder(LightTree& tree, std::span<const LightBounds> lights)
      : tree_(tree), lights_(lights), order_(lights.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    for (const LightBounds& light : lights) total_ += light.weight;
    tree.leaf_.resize(lights.size());
    tree.nodes_.reserve(2 * lights.size());
    tree.nodes_.resize(1);
    fill(0, order_, 0);
    if (tree.nodes_[0].radius > 0) tree.unit_ = tree.nodes_[0].radius;
  }

 private:
  static constexpr int kBins = 16;
  struct Cut {
    double cost = std::numeric_limits<double>::infinity();
    int axis = -1;
    int bin = 0;  // the last one of the first child
  };

  /// Makes node `index` that of `range`, and all below it.
  void fill(int index, std::span<int> range, int depth) {
    LightBounds all = lights_[range[0]];
    for (const int i : range.subspan(1)) all = all.united(lights_[i]);
    const int parent = tree_.nodes_[index].parent;
    Node node = node_of(all);
    node.parent = parent;
    node.group = parent < 0 ? -1 : tree_.nodes_[parent].group;
    if (node.group < 0 && (depth == kGroupDepth || range.size() == 1)) {
      node.group = tree_.groups();
      tree_.roots_.push_back(index);
    }
    if (range.size() == 1) {
      node.child = -1 - range[0];
      tree_.leaf_[range[0]] = index;
      tree_.nodes_[index] = node;
      return;
    }
    node.child = static_cast<int>(tree_.nodes_.size());
    tree_.nodes_[index] = node;
    tree_.nodes_.resize(tree_.nodes_.size() + 2);
    tree_.nodes_[node.child].parent = tree_.nodes_[node.child + 1].parent = index;
    const std::size_t middle = split(range, depth);
    fill(node.child, range.first(middle), depth + 1);
    fill(node.child + 1, range.subspan(middle), depth + 1);
    const double first = weight_of(range.first(middle));
    tree_.nodes_[node.child].part = static_cast<float>(first / all.weight);
  }

  double weight_of(std::span<const int> range) const {
    double sum = 0;
    for (const int i : range) sum += lights_[i].weight;
    return sum;
  }

  Node node_of(const LightBounds& all) const {
    const Bounds& box = all.extent.bounds;
    Node node;
    node.center = box.center();
    node.half = max(box.upper - node.center, node.center - box.lower);
    node.radius = std::min(length(node.half) * (1 + 0x1p-20f), kMaxRadius);
    node.axis = all.extent.axis;
    node.cos_normals = std::cos(all.extent.normals);
    node.sin_normals = all.extent.normals < kPi ? std::sin(all.extent.normals) : 0;
    node.cos_emission = std::cos(all.extent.emission);
    node.intensity = static_cast<float>(all.weight / total_ / std::max(1e-4, all.solid_angle()));
    return node;
  }

  /// Orders `range` so that the first child's lights come first; returns how many they are.
  std::size_t split(std::span<int> range, int depth) const {
    Bounds centers;
    for (const int i : range) centers.add(lights_[i].extent.bounds.center());
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
      const Cut cut = best_cut(range, axis, centers);
      if (cut.cost < best.cost) best = cut;
    }
    if (best.axis < 0 || depth > kMaxHeuristicDepth) return range.size() / 2;
    const auto middle = std::stable_partition(range.begin(), range.end(), [&](int i) {
      return bin_of(lights_[i], best.axis, centers) <= best.bin;
    });
    return static_cast<std::size_t>(middle - range.begin());
  }

  static int bin_of(const LightBounds& light, int axis, const Bounds& centers) {
    const float lower = centers.lower[axis], upper = centers.upper[axis];
    const float place = (coordinate(light, axis) - lower) / (upper - lower) * kBins;
    return std::clamp(static_cast<int>(place), 0, kBins - 1);
  }

  Cut best_cut(std::span<const int> range, int axis, const Bounds& centers) const {
    const float width = centers.upper[axis] - centers.lower[axis];
    if (!(width > 0) || !std::isfinite(width)) return {};
    std::array<LightBounds, kBins> bins;
    for (const int i : range) {
      LightBounds& bin = bins[bin_of(lights_[i], axis, centers)];
      bin = bin.weight > 0 ? bin.united(lights_[i]) : lights_[i];
    }
    std::array<double, kBins> cost{};  // of everything up to and including a bin
    sweep(bins, [&](int i, const LightBounds& sum) { cost[i] = sum.cost(); });
    std::reverse(bins.begin(), bins.end());
    Cut best;
    sweep(bins, [&](int i, const LightBounds& sum) {
      const int last = kBins - 2 - i;  // of the other side
      if (last < 0) return;
      const double both = cost[last] + sum.cost();
      if (both < best.cost) best = {both, axis, last};
    });
    return best;
  }

  /// Calls see(i, union of the bins up to i).
  template <class See>
  static void sweep(const std::array<LightBounds, kBins>& bins, const See& see) {
    LightBounds sum;
    for (int i = 0; i < kBins; ++i) {
      if (bins[i].weight > 0) sum = sum.weight > 0 ? sum.united(bins[i]) : bins[i];
      see(i, sum);
    }
  }

  LightTree& tree_;
  std::span<const LightBounds> lights_;
  std::vector<int> order_;
  double total_ = 0;  // of all weights
};

LightTree::LightTree(std::span<const LightBounds> lights) {
  if (!lights.empty()) Builder(*this, lights);
}

}  // namespace octolux
