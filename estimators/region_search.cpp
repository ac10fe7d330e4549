// region_search.h: how far the feelers go, and how often.
#include "estimators/region_search.h"

#include <algorithm>

namespace octolux {

namespace {

/// How far beyond the plain look-up the first feelers see. A corner's quarter disc holds its n
/// photons within twice the radius of the whole disc.
constexpr float kMargin = 2;

FeelerQuery feeler_query(const GatherPoint& at, const RegionConfig& config, float reach) {
  FeelerQuery query;
  query.point = at.at.point();
  query.normal = at.at.facing_normal();
  query.wo = at.at.wo();
  query.length = reach / std::cos(kPi / static_cast<float>(config.feelers));
  query.feelers = config.feelers;
  query.turn = at.turn;
  query.edges = config.edges;
  return query;
}

/// The distance no two points of the scene exceed, or max_radius.
float search_limit(const GatherPoint& at, const Bandwidth& bandwidth) {
  constexpr float kRounding = 1.01f;
  return std::min(bandwidth.max_radius, 2 * kRounding * at.caster->bounds().radius());
}

}  // namespace

RegionDisc find_in_region(const GatherPoint& at, const PhotonMap& map, const Bandwidth& bandwidth,
                          const RegionConfig& config, NeighbourBuffer& buffer) {
  RegionDisc result{find_disc(at, map, bandwidth, config.neighbours, buffer),
                    FreeRegion(at.at.facing_normal()), true};
  if (at.caster == nullptr || result.disc.empty()) return result;
  const std::size_t wanted = static_cast<std::size_t>(config.neighbours) + 1;
  const float limit = search_limit(at, bandwidth);
  const float scale = std::min(limit, std::sqrt(result.disc.h2) / bandwidth.shrink);
  PhotonQuery query = photon_query(at, bandwidth);
  for (float reach = std::min(limit, kMargin * scale); reach > 0;
       reach = std::min(limit, 2 * reach)) {
    result.region = FreeRegion(*at.caster, feeler_query(at, config, reach));
    if (result.whole && result.region.clearance() >= scale) return result;
    result.whole = false;
    query.region = &result.region.photons();
    query.max_radius = reach;
    std::span<const Neighbour> found = map.nearest(query, wanted, buffer);
    if (found.size() < wanted && reach < limit) continue;
    float h2 = reach * reach;
    if (found.size() == wanted) {
      h2 = found.back().distance2;
      found = found.first(found.size() - 1);
    }
    h2 *= bandwidth.shrink * bandwidth.shrink;
    result.disc = {found, h2 >= std::numeric_limits<float>::min() ? h2 : 0};
    return result;
  }
  return result;
}

}  // namespace octolux
