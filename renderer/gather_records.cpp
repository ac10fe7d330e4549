// gather_records.h.
#include "renderer/gather_records.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bsdf_makers.h"
#include "core/constants.h"
#include "core/rng.h"

namespace octolux {

namespace {

/// Where there are not even so many, the bandwidth is taken for narrower than look-ups have it:
/// with 20, gather rays of a corridor with few photons went on so often that it took 1.3 times as
/// long.
constexpr int kHeard = 64;

}  // namespace

float mean_bandwidth(const RadianceMap& map, const GatherPoint& at, int neighbours) {
  const int heard = std::max(neighbours, kHeard);
  const float share = static_cast<float>(neighbours) / static_cast<float>(heard);
  return map.bandwidth_at(at, heard) * std::sqrt(share);
}

GatherRecords::GatherRecords(RecordSites sites, const RadianceMap& map, const RayCaster& caster,
                             const RecordConfig& config)
    : map_(&map),
      caster_(&caster),
      config_(config),
      white_(make_diffuse(Color(Rgb(1)))),
      sites_(std::move(sites)),
      white_radiance_(sites_.size() * kDepths),
      arrivals_(sites_.size() * kDepths),
      spacing_(sites_.size()),
      detail_(sites_.size()),
      clearing_(config.must_see ? sites_.size() : 0),
      bandwidth_(sites_.size()) {
  for (std::uint32_t i = 0; i < map.photons().slots(); ++i) {
    longest_ = std::max(longest_, segments(map.photons().payload(i)));
  }
}

/// Calls `use` with the record as a gather point.
template <class Use>
auto GatherRecords::at_record(std::uint32_t record, int max_segments, const Use& use) const {
  const SurfacePoint point = sites_.point(record);
  const Scattering at(point, *white_, point.ng, Carried::radiance);
  const float turn = static_cast<float>(hash64(config_.turn_key ^ record) >> 40) * 0x1p-24f;
  return use(GatherPoint{at, max_segments, caster_, turn});
}

/// Which of a record's values counts photons up to `max_segments`; kDepths or more if none does.
int GatherRecords::depth_index(int max_segments) const {
  return std::min(config_.max_segments, longest_) - std::min(max_segments, longest_);
}

float GatherRecords::spacing(std::uint32_t record) const {
  return spacing_.get(record, [&] {
    const SurfacePoint there = sites_.point(record);
    return sites_.spacing(there.position, there.ng);
  });
}

float GatherRecords::reach(std::uint32_t record) const { return sites_.reach(spacing(record)); }

GatherRecords::Nearest GatherRecords::nearest(const GatherPoint& at) const {
  if (sites_.size() == 0 || at.at.bsdf().smooth_transmission()) return std::nullopt;
  return sites_.find(photon_query(at, map_->bandwidth()), at.at.facing_shading_normal());
}

bool GatherRecords::reaches(const Nearest& nearest) const {
  if (!nearest) return false;
  const float far = reach(nearest->record);
  return nearest->distance2 < far * far;
}

bool GatherRecords::is_detail(const GatherPoint& at, const Nearest& nearest) const {
  const float far = nearest ? spacing(nearest->record) : 0;
  if (!nearest || !(nearest->distance2 < far * far)) {
    const Vec3 position = at.at.point().position, normal = at.at.facing_normal();
    return sites_.is_detail(position, normal, sites_.spacing(position, normal));
  }
  return detail_.get(nearest->record, [&] {
    const SurfacePoint there = sites_.point(nearest->record);
    return sites_.is_detail(there.position, there.ng, far);
  });
}

/// How far the record sees, within its reach.
Clearing GatherRecords::clearing(std::uint32_t record) const {
  return clearing_.get(record, [&] {
    const SurfacePoint there = sites_.point(record);
    FeelerQuery query{.point = there, .normal = there.ng, .wo = there.ng, .edges = false};
    query.length = reach(record);
    return Clearing(*caster_, query, TangentPlane(query));
  });
}

/// Does the record see a point within its reach? Mostly known without a ray.
bool GatherRecords::sees(std::uint32_t record, const SurfacePoint& point, Vec3 normal) const {
  const Clearing free = clearing(record);
  if (free.whole()) return true;
  const SurfacePoint there = sites_.point(record);
  const Vec3 across = Frame::from_normal(there.ng).to_local(point.position - there.position);
  if (free.contains({across.x, across.y}, reach(record))) return true;
  return !caster_->occluded(connecting_ray({point.position, normal, point.error},
                                           {there.position, there.ng, there.error}));
}

std::optional<GatherRecords::Serving> GatherRecords::serving(const GatherPoint& at,
                                                             const Nearest& nearest) const {
  if (!nearest) return std::nullopt;
  const int depth = depth_index(at.max_segments);
  if (depth < 0 || depth >= kDepths || !reaches(nearest)) return std::nullopt;
  const std::uint32_t record = nearest->record;
  if (config_.must_see && !sees(record, at.at.point(), at.at.facing_normal())) return std::nullopt;
  return Serving{record, depth};
}

/// Radiance [W m^-2 sr^-1] that a white Lambertian surface would send out.
Rgb GatherRecords::white_radiance(const Serving& by) const {
  return white_radiance_.get(by.value(), [&] {
    return at_record(by.record, config_.max_segments - by.depth,
                     [&](const GatherPoint& there) { return map_->radiance(there); });
  });
}

const GatherRecords::Arrivals& GatherRecords::arrivals(const Serving& by) const {
  return arrivals_.get(by.value(), [&] {
    return at_record(by.record, config_.max_segments - by.depth, [&](const GatherPoint& there) {
      const Estimate estimate = map_->estimate(there);
      const float h2 = is_black(estimate.radiance) ? 0 : estimate.bandwidth * estimate.bandwidth;
      Arrivals found;
      for (const Neighbour& near : estimate.photons) {
        if (!(near.distance2 < h2)) continue;
        const float weight = kPi * map_->k(near.distance2 / h2) / estimate.area;
        found.push_back(
            {map_->photons().wi(near.photon), map_->photons().flux(near.photon) * weight});
      }
      return found;
    });
  });
}

std::optional<Rgb> GatherRecords::radiance(const GatherPoint& at, const Nearest& nearest) const {
  const std::optional<Serving> by = serving(at, nearest);
  if (!by) return std::nullopt;
  if (const std::optional<Rgb> reflectance = at.at.diffuse_reflectance()) {
    return *reflectance * white_radiance(*by);
  }
  Rgb sum(0);
  for (const Arriving& photon : arrivals(*by)) {
    sum += at.at.f_flux(photon.wi, Lobes::smooth) * photon.density;
  }
  return sum;
}

std::optional<float> GatherRecords::bandwidth(const GatherPoint& at) const {
  const Nearest found = nearest(at);
  if (!reaches(found)) return std::nullopt;
  return bandwidth_.get(found->record, [&] {
    const int segments = std::min(kMaxSegments, config_.max_segments + 1);
    return at_record(found->record, segments, [&](const GatherPoint& there) {
      return mean_bandwidth(*map_, there, config_.neighbours);
    });
  });
}

}  // namespace octolux
