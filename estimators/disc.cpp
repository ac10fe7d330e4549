// The plain estimate: every photon within h counts the same, k = 1/pi.
#include "estimators/radial.h"

namespace octolux {

namespace {
struct Flat {
  float k(float /*s*/) const { return kInvPi; }
};
}  // namespace

std::unique_ptr<Estimator> make_disc(const EstimatorConfig& config) {
  return std::make_unique<Radial<Flat>>(config.neighbours, Flat{});
}

}  // namespace octolux
