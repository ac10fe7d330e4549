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

/// Least share of a child that may contribute.
constexpr float kLeastShare = 1.0f / 1024;

/// Cosines of receiver and emitter count as no less than this, where there can be light at all: a
/// glossy or bumpy surface need not follow the cosine.
constexpr float kLeastCosine = 0.05f;

/// Slack in cosines before a node counts as unable to contribute: far above the rounding of
/// directions and cones (2^-22 at each of at most 100 levels), and so small that it costs nothing.
constexpr float kCosineSlack = 1e-4f;

/// Where one squared distance is not positive (a point on a point light), only an overflow must be
/// avoided: intensities are below 1e4, and this is no length that any scene resolves.
constexpr float kTiny = 1e-30f;

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

float coordinate(const LightBounds& light, int axis) { return light.extent.bounds.center()[axis]; }

}  // namespace

/// Top-down, 16 bins on each axis (their section 4.4, with LightBounds::cost).
class LightTree::Builder {
 public:
  Builder(LightTree& tree, std::span<const LightBounds> lights)
      : tree_(tree), lights_(lights), order_(lights.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    for (const LightBounds& light : lights) total_ += light.power;
    tree.leaf_.resize(lights.size());
    tree.nodes_.reserve(2 * lights.size());
    tree.nodes_.resize(1);
    fill(0, order_, 0);
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
  }

  Node node_of(const LightBounds& all) const {
    const Bounds& box = all.extent.bounds;
    Node node;
    node.center = box.center();
    const Vec3 reach = max(box.upper - node.center, node.center - box.lower);
    node.radius = length(reach) * (1 + 0x1p-20f);
    node.axis = all.extent.axis;
    node.cos_normals = std::cos(all.extent.normals);
    node.sin_normals = all.extent.normals < kPi ? std::sin(all.extent.normals) : 0;
    node.cos_emission = std::cos(all.extent.emission);
    node.intensity = static_cast<float>(all.power / total_ / std::max(1e-4, all.solid_angle()));
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
      bin = bin.power > 0 ? bin.united(lights_[i]) : lights_[i];
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
      if (bins[i].power > 0) sum = sum.power > 0 ? sum.united(bins[i]) : bins[i];
      see(i, sum);
    }
  }

  LightTree& tree_;
  std::span<const LightBounds> lights_;
  std::vector<int> order_;
  double total_ = 0;  // [W]
};

LightTree::LightTree(std::span<const LightBounds> lights) {
  if (!lights.empty()) Builder(*this, lights);
}

/// Irradiance to be expected at the receiver, were nothing in between: intensity along the axis,
/// times the best cosines any point of the node can have, over distance squared.
float LightTree::importance(const Node& node, const Receiver& at) {
  const Vec3 to_light = node.center - at.position;
  const float distance2 = length2(to_light);
  const float radius2 = node.radius * node.radius;
  if (!(distance2 > radius2)) return std::max(node.intensity / std::max(radius2, kTiny), kTiny);

  const float inverse = 1 / std::sqrt(distance2);
  const Vec3 wi = to_light * inverse;
  const float sin_seen = node.radius * inverse;  // half the angle under which the node is seen
  const float cos_seen = sine_of(sin_seen);

  const float cos_at = at.both_sides ? std::abs(dot(at.normal, wi)) : dot(at.normal, wi);
  const float cos_in = cos_of_rest(sine_of(cos_at), cos_at, sin_seen, cos_seen);
  if (cos_in < -kCosineSlack) return 0;

  float cos_out = 1;
  if (node.cos_normals > -1) {
    const float cos_axis = -dot(node.axis, wi), sin_axis = sine_of(cos_axis);
    const float cos_beyond = cos_of_rest(sin_axis, cos_axis, node.sin_normals, node.cos_normals);
    const float sin_beyond = sin_of_rest(sin_axis, cos_axis, node.sin_normals, node.cos_normals);
    cos_out = cos_of_rest(sin_beyond, cos_beyond, sin_seen, cos_seen);
    if (cos_out < node.cos_emission - kCosineSlack) return 0;
  }
  const float value = node.intensity * std::max(cos_in, kLeastCosine) *
                      std::max(cos_out, kLeastCosine) / std::max(distance2, kTiny);
  return std::max(value, kTiny);
}

/// Probability of `first`, the other child of its parent being first + 1.
float LightTree::first_share(const Receiver& at, int first) const {
  const float a = importance(nodes_[first], at);
  const float b = importance(nodes_[first + 1], at);
  if (a == 0 || b == 0) return a == b ? 0.5f : a > 0 ? 1.0f : 0.0f;
  return std::clamp(a / (a + b), kLeastShare, 1 - kLeastShare);
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
