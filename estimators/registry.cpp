// The table of kernels, made from list.def.
#include <algorithm>

#include "core/error.h"
#include "estimators/estimator.h"
#include "estimators/octobox_fit.h"

namespace octolux {

#define KERNEL(name) std::unique_ptr<Estimator> make_##name(const EstimatorConfig& config);
#include "estimators/list.def"
#undef KERNEL

namespace {

struct Entry {
  const char* name;
  std::unique_ptr<Estimator> (*make)(const EstimatorConfig&);
};

#define KERNEL(name) {#name, make_##name},
constexpr Entry kKernels[] = {
#include "estimators/list.def"
};
#undef KERNEL

}  // namespace

PhotonQuery photon_query(const GatherPoint& at, const Bandwidth& bandwidth) {
  PhotonQuery query;
  query.position = at.at.point().position;
  query.normal = at.at.facing_normal();
  query.max_radius = bandwidth.max_radius;
  query.max_segments = at.max_segments;
  query.both_sides = at.at.bsdf().smooth_transmission();
  return query;
}

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kKernels) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<Estimator> make_estimator(const EstimatorConfig& config) {
  if (config.neighbours < 1) throw Error("neighbours must be at least 1");
  if (!(config.cone_slope >= 1)) throw Error("cone_slope must be at least 1");
  if (config.feelers != 8 && config.feelers != 4) throw Error("feelers must be 8 or 4");
  parse_octant_use(config.octants);
  for (const Entry& entry : kKernels) {
    if (config.kernel == entry.name) return entry.make(config);
  }
  throw Error(unknown_name("kernel", config.kernel, kernel_names()));
}

}  // namespace octolux
