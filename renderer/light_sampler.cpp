// light_sampler.h: lights sorted into those of the tree and the infinite ones, and back from a
// shape to its leaf, so that a path that hits a light finds its pmf without a search.
#include "renderer/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "renderer/scene.h"

namespace octolux {

LightSampler::LightSampler(const Scene& scene) {
  std::vector<double> power;
  for (const auto& light : scene.lights) {
    lights_.push_back(light.get());
    const float watts = mean(light->power());  // a power beyond the floats counts as the largest
    power.push_back(watts > 0 ? std::min(watts, std::numeric_limits<float>::max()) : 0);
  }
  emission_ = Distribution1D(power);
  if (empty()) return;
  divide(power);

  for (std::size_t i = 0; i < infinite_.size(); ++i) {
    if (infinite_[i] == scene.environment) pmf_of_environment_ = kinds_.pmf(static_cast<int>(i));
  }
  std::vector<int> finite_of_light(lights_.size(), -1);
  for (std::size_t i = 0, next = 0; i < lights_.size(); ++i) {
    if (next < finite_.size() && lights_[i] == finite_[next]) {
      finite_of_light[i] = static_cast<int>(next++);
    }
  }
  for (const Shape& shape : scene.shapes) {
    finite_of_shape_.push_back(shape.light >= 0 ? finite_of_light[shape.light] : -1);
  }
}

/// Fills what `sample` looks at.
void LightSampler::divide(const std::vector<double>& power) {
  std::vector<LightBounds> bounds;
  std::vector<double> weights;
  double in_tree = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (power[i] == 0) continue;
    if (const std::optional<LightExtent> extent = lights_[i]->extent()) {
      bounds.push_back({*extent, std::sqrt(power[i])});
      finite_.push_back(lights_[i]);
      in_tree += power[i];
    } else {
      weights.push_back(power[i]);
      infinite_.push_back(lights_[i]);
    }
  }
  tree_ = LightTree(bounds);
  weights.push_back(in_tree);
  const double kinds = static_cast<double>(infinite_.size()) + (in_tree > 0 ? 1 : 0);
  for (double& w : weights) w = w > 0 ? 0.5 / kinds + 0.5 * w / total_power() : 0;
  kinds_ = Distribution1D(weights);
  pmf_of_tree_ = kinds_.pmf(static_cast<int>(infinite_.size()));
}

LightSampler::Choice LightSampler::sample(const Receiver& at, float u) const {
  if (empty()) return {};
  float share = 1;
  if (!infinite_.empty()) {
    const Distribution1D::Sample kind = kinds_.sample(u);
    if (kind.index < static_cast<int>(infinite_.size())) return {infinite_[kind.index], kind.pmf};
    share = kind.pmf;
    u = kind.u;
  }
  const LightTree::Choice chosen = tree_.sample(at, u);
  return {finite_[chosen.light], share * chosen.pmf};
}

LightSampler::Choice LightSampler::sample_for_emission(float u) const {
  const Distribution1D::Sample chosen = emission_.sample(u);
  if (chosen.pmf == 0) return {};
  return {lights_[chosen.index], chosen.pmf};
}

float LightSampler::pmf_of_shape(const Receiver& at, std::uint32_t shape) const {
  if (finite_of_shape_.empty() || finite_of_shape_[shape] < 0) return 0;
  return pmf_of_tree_ * tree_.pmf(at, finite_of_shape_[shape]);
}

}  // namespace octolux
