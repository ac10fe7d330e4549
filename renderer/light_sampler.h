// Which light? For next-event estimation one that matters at the point: finite lights stand in a
// tree that knows where they are (light_tree.h). Infinite ones reach every point alike; they and
// the tree as a whole share the probability, half of it evenly, half by power. Photons leave lights
// by power alone, so that all carry about the same flux. A light without power is never chosen. No
// light at all is legal: then nothing is ever chosen. A mesh of many triangles stands in the tree
// part by part (core/light_parts.h).
//
// Narrow lights, suns, are chosen apart from all others, with samples of their own: whether one is
// seen changes at the edge of a shadow, which neither power nor learning foresees.
//
// Where a Receiver knows what was learned (learned_lights.h), most choices follow that: first a
// group of lights, which is an infinite one or one of the tree's, then within it as ever.
// Immutable, so thread-safe.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/distribution.h"
#include "core/light.h"
#include "core/light_parts.h"
#include "renderer/light_tree.h"

namespace octolux {

struct Scene;

/// How many light samples a point takes: of narrow lights, and of all others.
struct LightSamples {
  int others = 0;
  int narrow = 0;
  bool any() const { return others + narrow > 0; }
  int of(const Light& light) const { return light.narrow() ? narrow : others; }
};

class LightSampler {
 public:
  /// `scene` must be complete and outlive the sampler.
  explicit LightSampler(const Scene& scene);

  struct Choice {
    const Light* light = nullptr;  // nullptr: there is nothing to choose
    float pmf = 0;
    const MeshParts* parts = nullptr;  // if it is but one part of the light
    int part = 0;
    int group = -1;
    float pmf_of_group = 0;  // where nothing is learned

    /// As Light::sample.
    std::optional<LightSample> sample(Vec3 x, Vec2 u) const {
      return parts ? parts->sample(part, x, u) : light->sample(x, u);
    }
  };
  /// A light for next-event estimation at `at`; `u` uniform in [0, 1). None where nothing was
  /// learned to bring light, but for now and then. O(log lights).
  Choice sample(const Receiver& at, float u) const;
  /// A light for a photon to leave, exactly in proportion to power (mean of the channels).
  Choice sample_for_emission(float u) const;
  /// One of the narrow lights, in proportion to power; none if there are none.
  Choice sample_narrow(float u) const;
  /// About n samples, at least one of either kind that there is.
  LightSamples divided(int n) const;

  /// Probability that `sample` chooses the area light that shape `shape` is, or the part of it that
  /// triangle `primitive` is in; 0 if it is none.
  float pmf_of_shape(const Receiver& at, std::uint32_t shape, std::uint32_t primitive = 0) const;
  /// Density [sr^-1] with which a choice by `sample` and a sample of it choose the direction from
  /// `at` to y, which is on `light`.
  float pdf_w(const Receiver& at, const AreaLight& light, const SurfacePoint& y) const;
  /// The same for a light that surrounds the scene and the direction `wi`.
  float pdf_w(const Receiver& at, const EnvironmentLight& light, Vec3 wi) const;
  /// Groups that can be told apart by learning.
  int groups() const { return infinite() + tree_.groups(); }

  /// Is there nothing to choose?
  bool empty() const { return !(total_power() > 0); }
  /// Sum over all lights of the mean of the channels [W].
  double total_power() const { return emission_.total(); }

 private:
  /// A leaf of the tree.
  struct Finite {
    const Light* light = nullptr;
    const MeshParts* parts = nullptr;  // if it is one of these
    int part = 0;
  };
  void divide(const std::vector<double>& power);
  bool only_narrow() const { return infinite_.empty() && finite_.empty(); }
  int infinite() const { return static_cast<int>(infinite_.size()); }
  Choice sample_unlearned(const Receiver& at, float u) const;
  Choice sample_learned(const Receiver& at, float u) const;
  Choice choice(const LightTree::Choice& leaf) const;
  void cut(const Scene& scene);

  std::vector<const Light*> lights_;
  Distribution1D emission_;
  std::vector<std::unique_ptr<MeshParts>> parts_;  // per light; nullptr: it is not cut
  std::vector<Finite> finite_;                     // those with power, as in the tree
  std::vector<const Light*> infinite_;             // those with power, as in `kinds_`
  LightTree tree_;
  Distribution1D kinds_;  // every infinite light, then the tree
  float pmf_of_tree_ = 0;
  std::vector<const Light*> narrow_lights_;  // those with power, as in `narrow_`
  Distribution1D narrow_;                    // by power
  /// Per shape: its parts or nullptr, and its (first) index in finite_ or -1.
  struct Leaves {
    const MeshParts* parts = nullptr;
    int first = -1;
  };
  std::vector<Leaves> leaves_of_shape_;
};

}  // namespace octolux
