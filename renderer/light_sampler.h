// Which light? For next-event estimation, where near lights matter whatever their power, half of
// the probability is spread evenly and half by power; photons leave lights by power alone, so that
// all carry about the same flux. A light without power is never chosen. No light at all is legal:
// then nothing is ever chosen. Immutable, so thread-safe.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distribution.h"
#include "core/light.h"

namespace octolux {

struct Scene;

class LightSampler {
 public:
  /// `scene` must be complete and outlive the sampler.
  explicit LightSampler(const Scene& scene);

  struct Choice {
    const Light* light = nullptr;  // nullptr: there is nothing to choose
    float pmf = 0;
  };
  /// A light for next-event estimation; `u` uniform in [0, 1). O(log lights).
  Choice sample(float u) const { return choose(direct_, u); }
  /// A light for a photon to leave, exactly in proportion to power (mean of the channels).
  Choice sample_for_emission(float u) const { return choose(emission_, u); }

  /// Probability that `sample` chooses the area light that shape `shape` is; 0 if it is none.
  float pmf_of_shape(std::uint32_t shape) const { return pmf_of_shape_[shape]; }
  /// Probability that `sample` chooses the environment; 0 if there is none.
  float pmf_of_environment() const { return pmf_of_environment_; }

  /// Is there nothing to choose?
  bool empty() const { return !(total_power() > 0); }
  /// Sum over all lights of the mean of the channels [W].
  double total_power() const { return emission_.total(); }

 private:
  Choice choose(const Distribution1D& distribution, float u) const;

  std::vector<const Light*> lights_;
  Distribution1D direct_;
  Distribution1D emission_;
  std::vector<float> pmf_of_shape_;
  float pmf_of_environment_ = 0;
};

}  // namespace octolux
