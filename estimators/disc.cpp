// The plain estimate: every photon within h counts the same, k = 1/pi.
#include "estimators/radial.h"

namespace octolux {

std::unique_ptr<Estimator> make_disc(const EstimatorConfig& config) {
  return std::make_unique<Radial<FlatKernel>>(config, FlatKernel{});
}

}  // namespace octolux
