// light_sampler.h: lights sorted into those of the tree and the infinite ones, and back from a
// shape to its leaf, so that a path that hits a light finds its pmf without a search.
#include "renderer/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/sampling.h"
#include "renderer/scene.h"

namespace octolux {

namespace {

/// Lamps of fewer triangles are not cut. One as large as the scene is cut into kMostParts, smaller
/// ones into so many fewer: what is small is seen from far, where its parts are all alike, and a
/// deeper tree takes longer. All together at most kMostPartsInAll.
constexpr std::size_t kManyTriangles = 16;
constexpr int kMostParts = 64, kMostPartsInAll = 1 << 14;
/// A part counts as no less than this share of its mesh, so that weights are above 0.
constexpr double kLeastShare = 1e-12;

/// This share of the choices does not follow what was learned: so much variance is lost at most
/// where it is wrong, and gained where it is right. (Measured: 1/4 is nearly as good.)
constexpr float kUnlearned = 0.125f;

/// -1 if it is none of them.
int index_of(const std::vector<const Light*>& lights, const Light& light) {
  const auto found = std::find(lights.begin(), lights.end(), &light);
  return found == lights.end() ? -1 : static_cast<int>(found - lights.begin());
}

/// Probability of a group which without learning is `pmf`.
float pmf_of_group(const Receiver& at, int group, float pmf) {
  if (at.learned.empty()) return pmf;
  const auto i = static_cast<std::size_t>(group);
  const float learned = at.learned[i] - (i > 0 ? at.learned[i - 1] : 0);
  return kUnlearned * pmf + (1 - kUnlearned) * learned;
}

}  // namespace

LightSampler::LightSampler(const Scene& scene) {
  std::vector<double> power;
  for (const auto& light : scene.lights) {
    lights_.push_back(light.get());
    const float watts = mean(light->power());  // a power beyond the floats counts as the largest
    power.push_back(watts > 0 ? std::min(watts, std::numeric_limits<float>::max()) : 0);
  }
  emission_ = Distribution1D(power);
  if (empty()) return;
  cut(scene);
  divide(power);

  std::vector<int> first(lights_.size(), -1);
  for (std::size_t i = 0, next = 0; i < lights_.size(); ++i) {
    if (next >= finite_.size() || lights_[i] != finite_[next].light) continue;
    first[i] = static_cast<int>(next);
    next += parts_[i] ? static_cast<std::size_t>(parts_[i]->size()) : 1;
  }
  for (const Shape& shape : scene.shapes) {
    leaves_of_shape_.push_back(
        shape.light < 0 ? Leaves{} : Leaves{parts_[shape.light].get(), first[shape.light]});
  }
}

/// Cuts meshes of many triangles into parts, if they emit.
void LightSampler::cut(const Scene& scene) {
  parts_.resize(lights_.size());
  const float scene_radius = scene.bounds.radius();
  int left = kMostPartsInAll;
  for (const Shape& shape : scene.shapes) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
    if (shape.light < 0 || !mesh || mesh->triangles.size() < kManyTriangles) continue;
    if (!(mean(lights_[shape.light]->power()) > 0) || !(scene_radius > 0)) continue;
    const float size = std::min(1.0f, bounds(shape).radius() / scene_radius);
    const int most = std::min(left, static_cast<int>(std::ceil(size * kMostParts)));
    if (most < 2) continue;
    const auto& light = static_cast<const AreaLight&>(*lights_[shape.light]);
    parts_[shape.light] = std::make_unique<MeshParts>(*mesh, light, most);
    left -= parts_[shape.light]->size();
  }
}

/// Fills what `sample` looks at.
void LightSampler::divide(const std::vector<double>& power) {
  std::vector<LightBounds> bounds;
  std::vector<double> weights, narrow;
  double in_tree = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (power[i] == 0) continue;
    if (lights_[i]->narrow()) {
      narrow.push_back(power[i]);
      narrow_lights_.push_back(lights_[i]);
    } else if (const MeshParts* parts = parts_[i].get()) {
      for (int k = 0; k < parts->size(); ++k) {
        const double share = std::max(parts->share(k), kLeastShare);
        bounds.push_back({parts->extent(k), std::sqrt(power[i]) * share});
        finite_.push_back({lights_[i], parts, k});
      }
      in_tree += power[i];
    } else if (const std::optional<LightExtent> extent = lights_[i]->extent()) {
      bounds.push_back({*extent, std::sqrt(power[i])});
      finite_.push_back({lights_[i]});
      in_tree += power[i];
    } else {
      weights.push_back(power[i]);
      infinite_.push_back(lights_[i]);
    }
  }
  tree_ = LightTree(bounds);
  narrow_ = Distribution1D(narrow);
  weights.push_back(in_tree);
  const double kinds = static_cast<double>(infinite_.size()) + (in_tree > 0 ? 1 : 0);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w = w > 0 ? 0.5 / kinds + 0.5 * w / total : 0;
  kinds_ = Distribution1D(weights);
  pmf_of_tree_ = kinds_.pmf(static_cast<int>(infinite_.size()));
}

/// Of a light of the tree; its pmf is still the one within its group.
LightSampler::Choice LightSampler::choice(const LightTree::Choice& leaf) const {
  const Finite& finite = finite_[leaf.light];
  return {finite.light, leaf.pmf_in_group,       finite.parts,
          finite.part,  infinite() + leaf.group, pmf_of_tree_ * leaf.pmf_of_group};
}

LightSampler::Choice LightSampler::sample_unlearned(const Receiver& at, float u) const {
  if (!infinite_.empty()) {
    const Distribution1D::Sample kind = kinds_.sample(u);
    if (kind.index < infinite()) {
      return {infinite_[kind.index], 1, nullptr, 0, kind.index, kind.pmf};
    }
    u = kind.u;
  }
  return choice(tree_.sample(at, u));
}

LightSampler::Choice LightSampler::sample_learned(const Receiver& at, float u) const {
  const auto found = std::upper_bound(at.learned.begin(), at.learned.end(), u);
  if (found == at.learned.end()) return {};
  const auto group = static_cast<int>(found - at.learned.begin());
  if (group < infinite()) {
    return {infinite_[group], 1, nullptr, 0, group, kinds_.pmf(group)};
  }
  const float below = group > 0 ? found[-1] : 0;
  const float within = std::min(kOneMinusEpsilon, (u - below) / (*found - below));
  return choice(tree_.sample_in(at, group - infinite(), within));
}

LightSampler::Choice LightSampler::sample(const Receiver& at, float u) const {
  if (only_narrow()) return {};
  Choice chosen;
  if (at.learned.empty()) {
    chosen = sample_unlearned(at, u);
  } else if (u < kUnlearned) {
    chosen = sample_unlearned(at, u / kUnlearned);
  } else {
    chosen = sample_learned(at, (u - kUnlearned) / (1 - kUnlearned));
  }
  if (chosen.light) chosen.pmf *= pmf_of_group(at, chosen.group, chosen.pmf_of_group);
  return chosen;
}

LightSampler::Choice LightSampler::sample_for_emission(float u) const {
  const Distribution1D::Sample chosen = emission_.sample(u);
  if (chosen.pmf == 0) return {};
  return {lights_[chosen.index], chosen.pmf};
}

LightSampler::Choice LightSampler::sample_narrow(float u) const {
  if (!(narrow_.total() > 0)) return {};
  const Distribution1D::Sample chosen = narrow_.sample(u);
  return {narrow_lights_[chosen.index], chosen.pmf};
}

LightSamples LightSampler::divided(int n) const {
  if (empty()) return {};
  if (narrow_lights_.empty()) return {n, 0};
  if (only_narrow()) return {0, n};
  const int narrow = std::max(1, n / 2);
  return {std::max(1, n - narrow), narrow};
}

float LightSampler::pmf_of_shape(const Receiver& at, std::uint32_t shape,
                                 std::uint32_t primitive) const {
  if (leaves_of_shape_.empty() || leaves_of_shape_[shape].first < 0) return 0;
  const Leaves& leaves = leaves_of_shape_[shape];
  const int part = leaves.parts ? leaves.parts->part_of(primitive) : 0;
  const Choice chosen = choice(tree_.choice(at, leaves.first + part));
  return chosen.pmf * pmf_of_group(at, chosen.group, chosen.pmf_of_group);
}

float LightSampler::pdf_w(const Receiver& at, const EnvironmentLight& light, Vec3 wi) const {
  if (const int narrow = index_of(narrow_lights_, light); narrow >= 0) {
    return narrow_.pmf(narrow) * light.pdf_w(wi);
  }
  const int index = index_of(infinite_, light);
  return index < 0 ? 0 : pmf_of_group(at, index, kinds_.pmf(index)) * light.pdf_w(wi);
}

float LightSampler::pdf_w(const Receiver& at, const AreaLight& light, const SurfacePoint& y) const {
  const float pmf = pmf_of_shape(at, y.shape, y.primitive);
  if (pmf == 0) return 0;
  const MeshParts* parts = leaves_of_shape_[y.shape].parts;
  return pmf * (parts ? parts->pdf_w(at.position, y) : light.pdf_w(at.position, y));
}

}  // namespace octolux
