// record_pass.h.
#include "renderer/record_pass.h"

#include <algorithm>

#include "core/parallel.h"
#include "renderer/glance.h"
#include "renderer/tracer.h"

namespace octolux {

namespace {

constexpr double kPhotonShare = 0.2;  // of the map's, where the bandwidth is not yet shrunk
constexpr double kLookShare = 0.012;  // gather rays, of the pass's
constexpr int kRaysPerLook = 2;       // gather rays, for one eye path
constexpr std::size_t kThinning = 3;  // of so many photons one is a site
constexpr std::int64_t kChunk = 256;  // eye paths

/// Eye paths that look for sites.
std::int64_t looks(const Scene& scene, const EyeConfig& eye) {
  const FilmSize& film = scene.film;
  const double gather_rays = static_cast<double>(film.crop_width) * film.crop_height *
                             eye.samples_per_pass * eye.gather_rays;
  return static_cast<std::int64_t>(kLookShare * gather_rays / kRaysPerLook) + 1;
}

/// Where gather rays end, and how many rays it took to know.
struct Found {
  std::vector<RecordSite> sites;
  std::int64_t rays = 0;
};

void look(const Scene& scene, Rng rng, Found& found) {
  Tracer tracer(scene, rng);
  follow_to_smooth(tracer, random_eye_ray(scene, tracer.rng), [&](const Scattering& at) {
    gather_from(tracer, at, kRaysPerLook, [&](const Scattering& there) {
      found.sites.push_back({there.point().position, there.facing_normal(),
                             there.facing_shading_normal(), there.point().error});
    });
  });
  found.rays += tracer.rays();
}

Found look_around(const Scene& scene, std::int64_t count, PassKey key) {
  std::vector<Found> parts(static_cast<std::size_t>((count + kChunk - 1) / kChunk));
  const auto trace = [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      look(scene, Rng(key.seed, Stream::look, key.pass, static_cast<std::uint64_t>(i)),
           parts[static_cast<std::size_t>(chunk)]);
    }
  };
  parallel_for_chunks(count, kChunk, trace);
  Found all;
  for (const Found& part : parts) {
    all.sites.insert(all.sites.end(), part.sites.begin(), part.sites.end());
    all.rays += part.rays;
  }
  return all;
}

}  // namespace

std::int64_t record_paths(std::int64_t photons, const Bandwidth& bandwidth) {
  const double share = std::min(1.0, kPhotonShare / (bandwidth.shrink * bandwidth.shrink));
  return static_cast<std::int64_t>(share * static_cast<double>(photons));
}

double most_record_sites(const Scene& scene, const EyeConfig& eye, double photons) {
  return kRaysPerLook * static_cast<double>(looks(scene, eye)) + photons / kThinning + 1;
}

RecordPass trace_record_sites(const Scene& scene, const PhotonSource& source,
                              const RenderConfig& config, const Bandwidth& bandwidth, PassKey key) {
  const PhotonPass traced = trace_photons(scene, source, PhotonKind::record,
                                          record_paths(config.photons.global, bandwidth), key);
  Found found = look_around(scene, looks(scene, config.eye), key);
  for (std::size_t i = 0; i < traced.photons.size(); i += kThinning) {
    const Photon& p = traced.photons[i];
    found.sites.push_back({p.position, p.normal, p.ns, p.error});
  }
  return {RecordSites(found.sites, traced.photons, bandwidth, config.estimator.neighbours,
                      config.eye.reuse),
          traced.rays + found.rays};
}

}  // namespace octolux
