// The OctoBox kernel (Tobler & Maierhofer 2006, section 4): sum of flux over the area that the
// photons cover, instead of the area of the disc they were looked for in. octobox_fit.h has the
// estimate of the area, octobox_table.h what it is divided by.
//
// At few photons a box is too noisy, and hands over to the disc: 1/area is a mean of both, with
// weights that depend on the number of photons alone, so that it stays unbiased on an open plane.
// Where a wall is seen to cut the disc, the disc is too dark, and hands back earlier.
#include <memory>

#include "estimators/octobox_fit.h"
#include "estimators/octobox_table.h"
#include "estimators/plane_photons.h"
#include "estimators/radial.h"

namespace octolux {
namespace {

/// Smaller shares of the disc are no area: the photons are on a line.
constexpr float kDegenerate = 1e-5f;

class OctoBox final : public Estimator {
 public:
  explicit OctoBox(const EstimatorConfig& config)
      : config_(config),
        use_(parse_octant_use(config.octants)),
        table_(make_octobox_corrections(use_, config.neighbours)) {}

  Estimate estimate(const GatherPoint& at, const PhotonMap& map,
                    const Bandwidth& bandwidth) const override {
    thread_local NeighbourBuffer buffer;
    const Disc disc = find_disc(at, map, bandwidth, disc_rule(config_), buffer);
    if (disc.empty()) return {};
    return config_.correction ? corrected(at, map, disc) : published(at, map, disc);
  }

  bool sees_geometry() const override { return disc_rule(config_).seen; }

 private:
  Estimate corrected(const GatherPoint& at, const PhotonMap& map, const Disc& disc) const {
    const OctoBoxCorrection& correction = table_[disc.photons.size()];
    if (share(correction, disc) == 0) return radial_sum(at, map, disc, FlatKernel{});
    thread_local PlanePoints points;
    const Estimate flat = sum_and_project(at, map, disc, points);
    return flat.count == 0 ? flat : raised(flat, gain(points, disc, correction, flat.count));
  }

  /// Area of the disc by that of the boxes.
  float gain(PlanePoints& points, const Disc& disc, const OctoBoxCorrection& correction,
             int count) const {
    const float radius = std::sqrt(disc.h2 / disc.r2);
    const Fit fit = fit_octobox(points, radius, use_);
    const float disc_area = kPi * radius * radius;
    if (!(fit.area > kDegenerate * disc_area)) return 1;
    const float density = fit.count / (fit.area * correction.ratio);
    const float box = share(correction, disc);
    return 1 - box + box * density * disc_area / static_cast<float>(count);
  }

  static float share(const OctoBoxCorrection& correction, const Disc& disc) {
    return disc.cut ? correction.cut_share : correction.share;
  }

  Estimate published(const GatherPoint& at, const PhotonMap& map, const Disc& disc) const {
    thread_local PlanePoints points;
    project_inner_photons(at, map, disc, points);
    const float disc_area = kPi * disc.h2 / disc.r2;
    const float area = published_octobox_area(points, use_);
    const Estimate flat = radial_sum(at, map, disc, FlatKernel{});
    return raised(flat, area > kDegenerate * disc_area ? disc_area / area : 1);
  }

  /// The flat estimate over the disc's area divided by `gain`.
  static Estimate raised(Estimate estimate, float gain) {
    estimate.radiance = in_range(estimate.radiance * gain);
    if (gain > 0) estimate.area /= gain;
    return estimate;
  }

  EstimatorConfig config_;
  OctantUse use_;
  std::vector<OctoBoxCorrection> table_;  // by number of photons
};

}  // namespace

std::unique_ptr<Estimator> make_octobox(const EstimatorConfig& config) {
  return std::make_unique<OctoBox>(config);
}

}  // namespace octolux
