// Estimators against truth, without rendering.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "estimators/estimator.h"
#include "tools/lab/world.h"

namespace octolux {

/// A kernel under test: "octobox", or with its options "octobox:eight:published".
struct LabKernel {
  std::string name;  // as typed
  EstimatorConfig config;
};
/// What the text does not say is as in `base`. Throws Error for anything that is no kernel with
/// legal options.
LabKernel parse_lab_kernel(const std::string& text, const EstimatorConfig& base = {});

struct LabSettings {
  std::vector<LabKernel> kernels;
  std::vector<int> neighbours;
  int runs = 4000;    // look-ups of 50 photons; for the same error, of n photons 50/n times as many
  double angle = -1;  // [degrees]; < 0: sixteen angles over the whole turn
  double shrink = 1;  // of the bandwidth
  PhotonPattern pattern = PhotonPattern::poisson;
  std::uint64_t seed = 1;
};

/// Statistics of estimate / truth over many look-ups.
struct LabResult {
  std::string kernel;
  int neighbours = 0;
  double angle = -1;
  int runs = 0;
  double mean = 0;
  double standard_error = 0;  // of the mean
  double deviation = 0;       // of one look-up
  double nanoseconds = 0;     // per query in a map of an open plane; 0: not measured
  double bias() const { return mean - 1; }
  double rmse() const;
};

/// One result per kernel and number of neighbours.
std::vector<LabResult> measure(const LabLayout& layout, const LabSettings& settings);

/// Adds the time of a query to each result.
void measure_time(const LabSettings& settings, std::vector<LabResult>& results);

/// A white surface at a query, so that pi times the radiance is the irradiance.
class LabQuery {
 public:
  /// `wo`: unit, towards the viewer. Kernels that look at the geometry need it at a point that is
  /// on a wall: there it alone says on which side.
  LabQuery(Vec3 position, Vec3 normal, Vec3 wo);
  LabQuery(Vec3 position, Vec3 normal) : LabQuery(position, normal, normal) {}
  /// The estimate with the irradiance [W m^-2] in place of the radiance.
  Estimate irradiance(const Estimator& estimator, const PhotonMap& map, const Bandwidth& bandwidth,
                      const RayCaster* caster, float turn) const;

 private:
  std::unique_ptr<Bsdf> white_;
  SurfacePoint point_;
  Vec3 wo_;
};

}  // namespace octolux
