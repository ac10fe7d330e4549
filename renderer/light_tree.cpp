// light_tree.h: building, and the importance of a node.
#include "renderer/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/sampling.h"

namespace octolux {

namespace {

/// This much of the probability at a node goes by the children's weights alone: what seems to bring
/// little light may yet be all there is, if the rest is hidden.
constexpr float kBlindShare = 0.2f;

/// And no child that may contribute gets less, which weights many orders apart could do.
constexpr float kLeastShare = 0x1p-16f;

/// Cosines of receiver and emitter count as no less than this, where there can be light at all: a
/// glossy or bumpy surface need not follow the cosine.
constexpr float kLeastCosine = 0.05f;

/// Slack in cosines before a node counts as unable to contribute: far above the rounding of
/// directions and cones (2^-22 at each of at most 100 levels), and so small that it costs nothing.
constexpr float kCosineSlack = 1e-4f;

/// Distances count as no shorter than this share of the lights' extent, so that nothing is infinite
/// on a point light; and what may contribute counts as no less than kTiny, however far away.
constexpr float kLeastDistance = 1e-6f;
constexpr float kTiny = 1e-30f;
constexpr float kMaxRadius = 1e18f;  // [m], whose square is a float

/// Below this depth nodes are halved without looking, so that no arrangement of lights makes the
/// tree deep.
constexpr int kMaxHeuristicDepth = 64;

/// Cosine of max(0, a - b), from sines and cosines of a and b in [0, pi].
float cos_of_rest(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 1 : cos_a * cos_b + sin_a * sin_b;
}
float sin_of_rest(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 0 : sin_a * cos_b - cos_a * sin_b;
}
float sine_of(float cosine) { return std::sqrt(std::max(0.0f, 1 - cosine * cosine)); }

/// Mean of max(0, h) over heights h from `height` - `spread` to `height` + `spread`; negative if
/// all are below 0 beyond doubt.
float mean_above(float height, float spread) {
  if (height >= spread) return height;
  const float top = height + spread;
  if (top <= 0) return top < -kCosineSlack ? -1 : 0;
  return top * top / (4 * spread);
}
/// The same of |h|.
float mean_size(float height, float spread) {
  const float size = std::abs(height);
  return size >= spread ? size : (size * size + spread * spread) / (2 * spread);
}

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

/// Intensity along the axis times cosines at either end over the distance cubed. Never infinite.
float LightTree::importance(const Node& node, const Receiver& at) const {
  const Vec3 to_light = node.center - at.position;
  const float distance = std::max({length(to_light), node.radius, kLeastDistance * unit_});
  const float inverse = 1 / distance;
  const float height = dot(at.normal, to_light) * inverse;
  const float spread = dot(abs(at.normal), node.half) * inverse;
  const float cos_in = at.both_sides ? mean_size(height, spread) : mean_above(height, spread);
  if (cos_in < 0) return 0;
  const float cos_out = emission(node, to_light * inverse, node.radius * inverse);
  if (cos_out < 0) return 0;
  const float value =
      node.intensity * std::max(cos_in, kLeastCosine) * std::max(cos_out, kLeastCosine);
  const float nearness = unit_ * inverse;
  return std::max(value * nearness * nearness * nearness, kTiny);
}

/// Cosine at the emitter, relative to its normal nearest to the receiver; negative if it cannot
/// shine there. `wi` is the unit vector to the center (shorter inside the bounding sphere), and
/// `sin_seen` the sine of half the angle under which the sphere is seen (1 inside).
float LightTree::emission(const Node& node, Vec3 wi, float sin_seen) {
  if (node.cos_normals <= -1) return 1;
  const float cos_axis = -dot(node.axis, wi);
  if (node.sin_normals == 0 && node.cos_emission <= 0) {
    const float s = sin_seen / node.radius;
    return mean_above(cos_axis, node.radius > 0 ? dot(abs(node.axis), node.half) * s : 0);
  }
  if (sin_seen >= 1) return 1;
  const float sin_axis = sine_of(cos_axis), cos_seen = sine_of(sin_seen);
  const float cos_beyond = cos_of_rest(sin_axis, cos_axis, node.sin_normals, node.cos_normals);
  const float sin_beyond = sin_of_rest(sin_axis, cos_axis, node.sin_normals, node.cos_normals);
  const float cos_out = cos_of_rest(sin_beyond, cos_beyond, sin_seen, cos_seen);
  return cos_out < node.cos_emission - kCosineSlack ? -1 : std::max(cos_out, 0.0f);
}

/// Probability of `first`, the other child of its parent being first + 1.
float LightTree::first_share(const Receiver& at, int first) const {
  const float a = importance(nodes_[first], at);
  const float b = importance(nodes_[first + 1], at);
  const float blind = nodes_[first].part;
  if (a == 0 || b == 0) return a > 0 ? 1.0f : b > 0 ? 0.0f : blind;
  const float share = (1 - kBlindShare) * (a / (a + b)) + kBlindShare * blind;
  return std::clamp(share, kLeastShare, 1 - kLeastShare);
}

LightTree::Choice LightTree::sample(const Receiver& at, float u) const {
  if (nodes_.empty()) return {};
  float pmf = 1;
  int index = 0;
  while (nodes_[index].child >= 0) {
    index = nodes_[index].child;
    const float first = first_share(at, index);
    const bool second = !(u < first);
    const float share = second ? 1 - first : first;
    u = std::min(kOneMinusEpsilon, (second ? u - first : u) / share);
    pmf *= share;
    index += second;
  }
  return {-1 - nodes_[index].child, pmf};
}

float LightTree::pmf(const Receiver& at, int light) const {
  float pmf = 1;
  for (int index = leaf_[light]; index > 0; index = nodes_[index].parent) {
    const bool second = index % 2 == 0;
    const float first = first_share(at, second ? index - 1 : index);
    pmf *= second ? 1 - first : first;
  }
  return pmf;
}

}  // namespace octolux
