// Before the eye pass: where its records lie (record_sites.h).
//
// Most lie where gather rays of eye paths of their own end, so that every place which is looked at
// has its share of them, however dark. Were they only where light lands, a dark place beside a
// bright one would be served from the bright one more often than the other way round: a bias. Some
// photons are sites, too: where the bandwidth is narrow, much is looked up within little.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/photon_pass.h"
#include "renderer/record_sites.h"

namespace octolux {

/// Photon paths that tell how far records of a map of `photons` paths reach: a fifth of them in the
/// first pass, and so many later that the reach of each holds as many as then.
std::int64_t record_paths(std::int64_t photons, const Bandwidth& bandwidth);

/// Sites of a pass where `photons` such photons are traced, at most.
double most_record_sites(const Scene& scene, const EyeConfig& eye, double photons);

/// What a pass found: sites, and the photons that tell how far each serves.
struct RecordPass {
  std::vector<RecordSite> sites;
  std::vector<Photon> photons;
  std::int64_t rays = 0;
};

/// The same on any number of threads. `config` is resolved.
RecordPass trace_record_sites(const Scene& scene, const PhotonSource& source,
                              const RenderConfig& config, const Bandwidth& bandwidth, PassKey key);

}  // namespace octolux
