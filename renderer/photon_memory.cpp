// photon_memory.h.
#include "renderer/photon_memory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "renderer/gather_records.h"
#include "renderer/photon_pass.h"
#include "renderer/record_pass.h"
#include "renderer/stop_rules.h"

namespace octolux {

namespace {

constexpr std::int64_t kTrials = 4096;  // paths of a kind
constexpr double kUsableShare = 0.9;    // of the memory: scene and film need some, too

/// Bytes of a photon that is only traced, and of one in a map.
constexpr double kTraced = sizeof(Photon);
constexpr double kInMap = sizeof(PhotonPayload) + PhotonTree::kBytesPerItem;

/// Photons a path stores.
double stored(const Scene& scene, const PhotonSource& source, PhotonKind kind, PassKey key) {
  const PhotonPass trial = trace_photons(scene, source, kind, kTrials, key);
  return static_cast<double>(trial.photons.size()) / kTrials;
}

}  // namespace

PhotonMemory foresee_photons(const Scene& scene, const LightSampler& lights, const PhotonAim& aim,
                             const RenderConfig& config) {
  const PassKey key{config.seed, 0};
  const bool gather = config.eye.gather;
  const double per_path = stored(scene, {lights, aim.global, !gather}, PhotonKind::global, key);
  const double global = per_path * static_cast<double>(config.photons.global);
  double caustic = 0, reach = 0, sites = 0;  // reach: photons that tell how far records serve
  if (gather && config.photons.caustic > 0) {
    caustic = stored(scene, {lights, aim.caustic}, PhotonKind::caustic, key) *
              static_cast<double>(config.photons.caustic);
  }
  if (gather) {
    const int last = std::max(1, pass_limit(config)) - 1;
    const Bandwidth bandwidth =
        look_up_bandwidth(scene, config, PhotonKind::global, 1, static_cast<std::uint64_t>(last));
    reach = per_path * static_cast<double>(record_paths(config.photons.global, bandwidth));
    sites = most_record_sites(scene, config.eye, reach);
  }
  // As they are made (render.cpp), each while those before it stay.
  const double found = sizeof(RecordSite) * sites + kTraced * reach;
  const double records =
      GatherRecords::kBytesPerRecord * sites + RecordSites::kBytesPerPhoton * reach;
  const double bytes = std::max({kBytesToMap * global, kInMap * global + found + records,
                                 kInMap * global + records + kBytesToMap * caustic});
  return {global + caustic, bytes};
}

void check_photons(const PhotonMemory& needed, const RenderConfig& config, double memory) {
  const std::string asked =
      fmt::format("photons: {} paths for the global map and {} for the caustic one store",
                  config.photons.global, config.photons.caustic);
  if (needed.photons > PhotonTree::kMaxItems) {
    throw Error(fmt::format("{} about {:.3g} photons; expected at most {:.3g}", asked,
                            needed.photons, static_cast<double>(PhotonTree::kMaxItems)));
  }
  if (needed.bytes > kUsableShare * memory) {
    throw Error(fmt::format(
        "{} photons of {:.3g} GB; expected at most {:.3g} GB, as this machine has {:.3g}", asked,
        1e-9 * needed.bytes, 1e-9 * kUsableShare * memory, 1e-9 * memory));
  }
}

double physical_memory() {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  double group = 0;  // "max" if there is no limit
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> group) return std::min(machine, group);
  return machine;
}

}  // namespace octolux
