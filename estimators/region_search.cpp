// region_search.h: how far the feelers go, and how often. None are sent where the scene says that
// nothing is as near as the photons are: those are the nearest of the free region as well.
#include "estimators/region_search.h"

#include <algorithm>

#include "estimators/clearance.h"

namespace octolux {

namespace {

/// How far to look at first, in units of the guess. Farther finds more than is needed; less far
/// must more often be followed by a second look.
constexpr float kMargin = 1.3f;
/// How much farther beside walls, which leave less of the disc.
constexpr float kWallMargin = 1.4f;
/// Below this part of that distance the surface is hardly free as far as the photons reach.
constexpr float kWorthLooking = 0.67f;

/// The distance no two points of the scene exceed, or max_radius.
float search_limit(const GatherPoint& at, const Bandwidth& bandwidth) {
  constexpr float kRounding = 1.01f;
  return std::min(bandwidth.max_radius, 2 * kRounding * at.caster->bounds().radius());
}

float first_reach(const PhotonMap& map, const PhotonQuery& query, std::size_t wanted, float limit) {
  const float reach = kMargin * map.rough_distance(query.position, query.normal, wanted);
  return reach > 0 ? std::min(reach, limit) : limit;
}

/// So that the region is known as far as `reach`. Where that is as far as photons may count no
/// second look follows: there feelers go farther, so that one more of them meets a wall that ends.
float feeler_length(float reach, float limit, int feelers) {
  const float known = reach < limit ? reach : kWallMargin * limit;
  return known / std::cos(kPi / static_cast<float>(feelers));
}

}  // namespace

FeelerQuery feeler_query(const GatherPoint& at, int feelers) {
  FeelerQuery query;
  query.point = at.at.point();
  query.normal = at.at.facing_normal();
  query.wo = at.at.wo();
  query.feelers = feelers;
  query.turn = at.turn;
  return query;
}

RegionDisc find_in_region(const GatherPoint& at, const PhotonMap& map, const Bandwidth& bandwidth,
                          const RegionConfig& config, NeighbourBuffer& buffer) {
  RegionDisc result{{}, FreeRegion(at.at.facing_normal())};
  if (at.caster == nullptr) {
    result.disc = find_disc(at, map, bandwidth, {config.neighbours}, buffer);
    return result;
  }
  const std::size_t wanted = static_cast<std::size_t>(config.neighbours) + 1;
  const float limit = search_limit(at, bandwidth);
  PhotonQuery query = photon_query(at, bandwidth);
  FeelerQuery feelers = feeler_query(at, config.feelers);
  feelers.edges = config.edges;
  float reach = first_reach(map, query, wanted, limit);
  if (!(reach > 0)) return result;
  for (bool obstructed = false;; reach = std::min(2 * reach, limit)) {
    std::span<const Neighbour> found;
    if (!obstructed) {
      feelers.length = feeler_length(reach, limit, config.feelers);
      query.max_radius = free_distance(*at.caster, feelers, reach, reach * kWorthLooking);
      obstructed = query.max_radius < reach;
      if (query.max_radius > 0) found = map.nearest(query, wanted, buffer);
      if (obstructed) reach = std::min(reach * kWallMargin, limit);
    }
    if (obstructed && found.size() < wanted) {
      feelers.length = feeler_length(reach, limit, config.feelers);
      result.region = FreeRegion(*at.caster, feelers);
      query.region = &result.region.photons();
      query.max_radius = std::min(reach, result.region.extent());
      found = map.nearest(query, wanted, buffer);
    }
    if (found.size() == wanted) {
      result.disc = {found.first(found.size() - 1), 0, found.back().distance2};
      break;
    }
    const float all = std::min(result.region.extent(), limit);
    if (reach < all) continue;
    result.disc = {found, 0, all * all};
    break;
  }
  Disc& disc = result.disc;
  disc.h2 = usable_bandwidth2(disc.r2 * (bandwidth.shrink * bandwidth.shrink));
  return result;
}

}  // namespace octolux
