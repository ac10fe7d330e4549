// Jensen's cone filter: weight 1 - d / (kappa h) over the area (1 - 2 / (3 kappa)) pi h^2.
#include "estimators/radial.h"

namespace octolux {

namespace {
struct Cone {
  float inv_slope;      // 1 / kappa
  float normalisation;  // 1 / ((1 - 2 / (3 kappa)) pi)
  float k(float s) const { return (1 - std::sqrt(s) * inv_slope) * normalisation; }
};
}  // namespace

std::unique_ptr<Estimator> make_cone(const EstimatorConfig& config) {
  const float inv_slope = 1 / config.cone_slope;
  return std::make_unique<Radial<Cone>>(config, Cone{inv_slope, kInvPi / (1 - 2 * inv_slope / 3)});
}

}  // namespace octolux
