// light_sampler.h: two distributions over the scene's lights, and the first one's values spread out
// by shape, so that a path that hits a light finds its pmf without a search.
#include "renderer/light_sampler.h"

#include <algorithm>
#include <limits>

#include "renderer/scene.h"

namespace octolux {

LightSampler::LightSampler(const Scene& scene) {
  std::vector<double> power;
  double total = 0, lit = 0;
  for (const auto& light : scene.lights) {
    lights_.push_back(light.get());
    const float watts = mean(light->power());  // a power beyond the floats counts as the largest
    power.push_back(watts > 0 ? std::min(watts, std::numeric_limits<float>::max()) : 0);
    total += power.back();
    lit += power.back() > 0;
  }
  emission_ = Distribution1D(power);

  std::vector<double> weights;
  for (const double p : power) weights.push_back(p > 0 ? 0.5 / lit + 0.5 * p / total : 0);
  direct_ = Distribution1D(weights);

  for (const Shape& shape : scene.shapes) {
    pmf_of_shape_.push_back(shape.light >= 0 ? direct_.pmf(shape.light) : 0);
  }
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (lights_[i] == scene.environment) pmf_of_environment_ = direct_.pmf(static_cast<int>(i));
  }
}

LightSampler::Choice LightSampler::choose(const Distribution1D& distribution, float u) const {
  const Distribution1D::Sample chosen = distribution.sample(u);
  if (chosen.pmf == 0) return {};
  return {lights_[chosen.index], chosen.pmf};
}

}  // namespace octolux
