// The paper's second heuristic (Tobler & Maierhofer 2006, section 4): geometry feelers decide which
// photons count, OctoBoxes around those say how much surface they cover.
//
// As published: the n nearest photons; feelers of their distance in fixed directions; the photons
// inside the box at the feelers' ends; their flux over their OctoBox's area.
//
// Corrected: the n nearest photons in the free region R (free_region.h, without its probes: the box
// finds free edges). Where the disc lies in R, that is the octobox kernel. Elsewhere one OctoBox
// around the photons, and photons strictly inside it over the area that box, R and disc have in
// common, have the mean of the density for the same reason (octobox_fit.h): R is known, and given
// the box the photons inside are uniform. Its axes are those of the feelers, which no photon has
// chosen, so there is nothing to divide by; R knows the walls' angles. At few photons it hands over
// to the flat estimate over R and disc, as that kernel does to the disc. Immutable, thread-safe.
#include <memory>

#include "estimators/octobox_fit.h"
#include "estimators/octobox_table.h"
#include "estimators/plane_photons.h"
#include "estimators/radial.h"
#include "estimators/region_search.h"

namespace octolux {
namespace {

/// Smaller shares of the disc are no area: the photons are on a line, the query is in a wall.
constexpr double kDegenerate = 1e-5;

/// The look-up's photons in the region's axes, in units of the look-up's radius.
void project_into(const PhotonRegion& region, const GatherPoint& at, const PhotonMap& map,
                  const Disc& disc, PlanePoints& points) {
  const Vec3 origin = at.at.point().position;
  const float scale = 1 / std::sqrt(disc.r2);
  points.resize(static_cast<int>(disc.photons.size()));
  int i = 0;
  for (const Neighbour& near : disc.photons) {
    const Vec3 d = (map.position(near.photon) - origin) * scale;
    points.set(i++, {dot(d, region.s), dot(d, region.t)}, near.distance2 < disc.h2);
  }
}

class FeelerFilter final : public Estimator {
 public:
  explicit FeelerFilter(const EstimatorConfig& config)
      : config_(config),
        use_(parse_octant_use(config.octants)),
        table_(make_octobox_corrections(use_, config.neighbours)),
        one_(make_octobox_corrections(OctantUse::one, config.neighbours)) {}

  Estimate estimate(const GatherPoint& at, const PhotonMap& map,
                    const Bandwidth& bandwidth) const override {
    return config_.correction ? corrected(at, map, bandwidth) : published(at, map, bandwidth);
  }

  bool sees_geometry() const override { return true; }

 private:
  Estimate corrected(const GatherPoint& at, const PhotonMap& map,
                     const Bandwidth& bandwidth) const {
    thread_local NeighbourBuffer buffer;
    const RegionConfig region{config_.neighbours, config_.feelers, false};
    RegionDisc found = find_in_region(at, map, bandwidth, region, buffer);
    if (found.disc.empty()) return {};
    const float h = std::sqrt(found.disc.h2);
    const double disc_area = std::numbers::pi * h * h;
    double area = found.whole() ? disc_area : found.region.integral(h, 0);
    const bool in_wall = !(area > kDegenerate * disc_area);
    if (in_wall) {
      found.disc = find_disc(at, map, bandwidth, {config_.neighbours}, buffer);
      if (found.disc.empty()) return {};
      area = std::numbers::pi * found.disc.h2;
    }
    thread_local PlanePoints points;
    const bool whole = in_wall || found.whole();
    Estimate estimate = whole ? sum_and_project(at, map, found.disc, points)
                              : radial_sum(at, map, found.disc, FlatKernel{});
    if (estimate.count == 0) return estimate;
    const double flat = std::numbers::pi * found.disc.h2 / area;
    const double density = whole ? disc_gain(points, found.disc, estimate.count)
                                 : region_gain(at, map, found, area, estimate.count);
    const auto gain = static_cast<float>(flat * density);
    estimate.radiance = in_range(estimate.radiance * gain);
    estimate.area /= gain > 0 ? gain : 1;
    return estimate;
  }

  /// Density of the photons by that of a flat estimate over the whole disc.
  double disc_gain(PlanePoints& points, const Disc& disc, int count) const {
    const OctoBoxCorrection& correction = table_[disc.photons.size()];
    if (correction.share == 0) return 1;
    const float radius = std::sqrt(disc.h2 / disc.r2);
    const Fit fit = fit_octobox(points, radius, use_);
    return blend(correction, fit, kPi * radius * radius, count);
  }

  /// The same over a region of which `area` [m^2] is in the disc.
  double region_gain(const GatherPoint& at, const PhotonMap& map, const RegionDisc& found,
                     double area, int count) const {
    const Disc& disc = found.disc;
    const OctoBoxCorrection& correction = one_[disc.photons.size()];
    if (correction.share == 0) return 1;
    thread_local PlanePoints points;
    project_into(found.region.photons(), at, map, disc, points);
    const Lanes box = octobox_with_origin(points);
    Lanes sides = box;
    for (float& side : sides) side *= std::sqrt(disc.r2);
    const double box_area = found.region.area_in_box(std::sqrt(disc.h2), sides);
    const float scale = 1 / disc.r2;
    const Fit fit{count_inside(points, box), static_cast<float>(box_area) * scale};
    return blend({1, correction.share}, fit, static_cast<float>(area) * scale, count);
  }

  static double blend(const OctoBoxCorrection& correction, const Fit& fit, float area, int count) {
    if (!(fit.area > kDegenerate * area)) return 1;
    const float density = fit.count / (fit.area * correction.ratio);
    return 1 - correction.share + correction.share * density * area / static_cast<float>(count);
  }

  Estimate published(const GatherPoint& at, const PhotonMap& map,
                     const Bandwidth& bandwidth) const {
    thread_local NeighbourBuffer buffer;
    thread_local std::vector<Neighbour> inside;
    Disc disc = find_disc(at, map, bandwidth, disc_rule(config_), buffer);
    if (disc.empty()) return {};
    inside.clear();
    const std::optional<PhotonRegion> box = feelers(at, std::sqrt(disc.h2));
    for (const Neighbour& near : disc.photons) {
      const Vec3 offset = map.position(near.photon) - at.at.point().position;
      if (!box || box->contains(offset)) inside.push_back(near);
    }
    disc.photons = inside;
    if (disc.empty()) return {};
    Estimate estimate = radial_sum(at, map, disc, FlatKernel{});
    thread_local PlanePoints points;
    project_inner_photons(at, map, disc, points);
    const float disc_area = kPi * disc.h2 / disc.r2;
    const float area = published_octobox_area(points, use_);
    const float gain = area > kDegenerate * disc_area ? disc_area / area : 1;
    estimate.radiance = in_range(estimate.radiance * gain);
    estimate.area /= gain;
    return estimate;
  }

  std::optional<PhotonRegion> feelers(const GatherPoint& at, float length) const {
    if (at.caster == nullptr) return std::nullopt;
    FeelerQuery query = feeler_query(at, config_.feelers);
    query.length = length;
    query.turn = 0;
    return feeler_box(*at.caster, query);
  }

  EstimatorConfig config_;
  OctantUse use_;
  std::vector<OctoBoxCorrection> table_;  // by number of photons
  std::vector<OctoBoxCorrection> one_;    // the same for one box
};

}  // namespace

std::unique_ptr<Estimator> make_feeler(const EstimatorConfig& config) {
  return std::make_unique<FeelerFilter>(config);
}

}  // namespace octolux
