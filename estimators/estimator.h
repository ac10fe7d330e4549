// Density estimation: from the photons around a point to the radiance leaving it.
//
// A kernel is one .cpp, one test and one line in list.def; it makes one virtual call per look-up
// and none per photon. Bandwidth: h = shrink * min(r, max_radius), where r is the distance of the
// (n+1)th nearest photon, which is itself left out. Given r, the n nearer photons are uniform in
// its disc, so the estimate is unbiased on a uniform plane at any n and any shrink in (0, 1]; where
// r > max_radius it is the plain estimate at that radius (the two cases together are exactly
// unbiased for Poisson photons). With `correction` off r is, as published, the distance of the nth
// photon, which counts as well.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "accel/photon_map.h"
#include "accel/ray_caster.h"
#include "core/constants.h"
#include "core/scattering.h"

namespace octolux {

struct EstimatorConfig {
  std::string kernel = "octobox";
  int neighbours = 20;           // n; the bandwidth is the distance of the next one
  float cone_slope = 1;          // kappa >= 1 of the cone filter (Jensen)
  std::string octants = "auto";  // OctoBoxes: one, eight (one per octant), auto (as photons allow)
  bool correction = true;        // false: as published, with the bias of finite photon counts
  int feelers = 8;               // geometry feelers per look-up: 8 or 4
  bool seen = false;             // with correction: count only photons that the point sees
};

/// Where radiance is wanted.
struct GatherPoint {
  const Scattering& at;               // point, BSDF and wo
  int max_segments = kMaxSegments;    // photons with longer paths do not count
  const RayCaster* caster = nullptr;  // for kernels that look at the geometry around the point
  float turn = 0;                     // random in [0, 1), independent of the photons
};

/// How wide a look-up may be: the same for all look-ups in one map of one pass.
struct Bandwidth {
  float max_radius = kInfinity;  // [m]
  float shrink = 1;              // s_k of the pass, in (0, 1]
};

/// What a look-up found: radiance = sum of pi k(d^2/h^2) f(wo, wi) flux over the photons nearer
/// than h, over `area`.
struct Estimate {
  Rgb radiance;         // [W m^-2 sr^-1] leaving at.point towards at.wo by the smooth lobes
  float bandwidth = 0;  // h [m]
  float area = 0;       // [m^2]
  int count = 0;        // photons that took part
  std::span<const Neighbour> photons;  // and others; this thread's next estimate overwrites them
};

/// Immutable, thread-safe.
class Estimator {
 public:
  virtual ~Estimator() = default;
  virtual Estimate estimate(const GatherPoint& at, const PhotonMap& map,
                            const Bandwidth& bandwidth) const = 0;
  /// k [1] of Estimate, for s = d^2/h^2 in [0, 1); pi times its integral over s is 1.
  virtual float k(float /*s*/) const { return kInvPi; }
  /// Does it take only photons that the point sees?
  virtual bool sees_geometry() const { return false; }
};

/// The query every kernel starts from: facing normal, which sides count, path length.
PhotonQuery photon_query(const GatherPoint& at, const Bandwidth& bandwidth);

/// Names in list.def, in that order.
std::vector<std::string> kernel_names();

/// Throws Error for an unknown kernel or values out of range.
std::unique_ptr<Estimator> make_estimator(const EstimatorConfig& config);

}  // namespace octolux
