// light_tree.h: the importance of a node, and walking down the tree and up.
#include "renderer/light_tree.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

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

/// Probability of a node, once the walk has come to its parent.
float LightTree::share(const Receiver& at, int index) const {
  const bool second = index % 2 == 0;
  const float first = first_share(at, second ? index - 1 : index);
  return second ? 1 - first : first;
}

LightTree::Choice LightTree::descend(const Receiver& at, float u, int index) const {
  Choice chosen{-1, -1, 1, 1};
  while (nodes_[index].child >= 0) {
    float& pmf = nodes_[index].group < 0 ? chosen.pmf_of_group : chosen.pmf_in_group;
    index = nodes_[index].child;
    const float first = first_share(at, index);
    const bool second = !(u < first);
    const float share = second ? 1 - first : first;
    u = std::min(kOneMinusEpsilon, (second ? u - first : u) / share);
    pmf *= share;
    index += second;
  }
  chosen.light = -1 - nodes_[index].child;
  chosen.group = nodes_[index].group;
  return chosen;
}

LightTree::Choice LightTree::sample(const Receiver& at, float u) const {
  return nodes_.empty() ? Choice{} : descend(at, u, 0);
}

LightTree::Choice LightTree::sample_in(const Receiver& at, int group, float u) const {
  Choice chosen = descend(at, u, roots_[group]);
  for (int i = roots_[group]; i > 0; i = nodes_[i].parent) chosen.pmf_of_group *= share(at, i);
  return chosen;
}

LightTree::Choice LightTree::choice(const Receiver& at, int light) const {
  Choice chosen{light, nodes_[leaf_[light]].group, 1, 1};
  for (int i = leaf_[light]; i > 0; i = nodes_[i].parent) {
    const bool above = nodes_[nodes_[i].parent].group < 0;
    (above ? chosen.pmf_of_group : chosen.pmf_in_group) *= share(at, i);
  }
  return chosen;
}

}  // namespace octolux
