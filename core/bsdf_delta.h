// Base of the BSDFs that have delta lobes only: nothing for f and pdf_w to see.
#pragma once

#include "core/bsdf.h"

namespace octolux {

class DeltaBsdf : public Bsdf {
 public:
  Rgb f(const SurfacePoint&, Vec3, Vec3, Lobes, Carried) const final { return Rgb(0); }
  float pdf_w(const SurfacePoint&, Vec3, Vec3, Lobes) const final { return 0; }

 protected:
  explicit DeltaBsdf(bool passes_light = false) : Bsdf(Lobes::delta, false, passes_light) {}

  /// A delta sample, or empty if it is black.
  static std::optional<BsdfSample> delta_sample(Vec3 wi, Rgb weight, float probability,
                                                float eta = 1) {
    if (is_black(weight)) return std::nullopt;
    return BsdfSample{wi, weight, probability, Lobes::delta, eta};
  }
};

}  // namespace octolux
