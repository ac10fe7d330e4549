// The convex hull kernel (Jensen 2001): sum of flux over the area of the photons' hull. OctoBoxes
// approximate it; it is here to be compared with, not for speed.
//
// As published: all photons over the whole hull. Corrected: the photons inside over the hull of
// photons and query, which is unbiased for every convex region without any table (octobox_fit.h);
// at few photons it hands over to the disc as OctoBoxes do.
#include <algorithm>
#include <limits>
#include <memory>

#include "estimators/convex_hull.h"
#include "estimators/octobox_table.h"
#include "estimators/plane_photons.h"
#include "estimators/radial.h"

namespace octolux {
namespace {

constexpr double kDegenerate = 1e-5;  // share of the disc

class Hull final : public Estimator {
 public:
  explicit Hull(const EstimatorConfig& config) : config_(config) {}

  Estimate estimate(const GatherPoint& at, const PhotonMap& map,
                    const Bandwidth& bandwidth) const override {
    thread_local NeighbourBuffer buffer;
    const Disc disc = find_disc(at, map, bandwidth, disc_rule(config_), buffer);
    if (disc.empty()) return {};
    Estimate estimate = radial_sum(at, map, disc, FlatKernel{});
    const double gain =
        config_.correction ? corrected(at, map, disc, estimate.count) : published(at, map, disc);
    estimate.radiance = in_range(estimate.radiance * static_cast<float>(gain));
    if (gain > 0) estimate.area /= static_cast<float>(gain);
    return estimate;
  }

  bool sees_geometry() const override { return disc_rule(config_).seen; }

 private:
  /// Area of the disc by that of the hull.
  double corrected(const GatherPoint& at, const PhotonMap& map, const Disc& disc, int count) const {
    const auto n = static_cast<int>(disc.photons.size());
    const double share = disc.cut ? box_share_of_cut(n) : box_share(OctantUse::one, n);
    if (share == 0 || count == 0) return 1;
    thread_local PlanePoints photons;
    project_photons(at, map, disc, photons);
    std::vector<Point2> points{{0, 0}};
    for (int i = 0; i < photons.size(); ++i) points.push_back({photons[i].x, photons[i].y});
    const std::vector<Point2> hull = convex_hull(points);
    const double radius = std::sqrt(disc.h2 / disc.r2);
    const double area = polygon_area(hull, radius);
    const double disc_area = static_cast<double>(kPi) * radius * radius;
    if (!(area > kDegenerate * disc_area)) return 1;
    const int corners = count_inside_corners(photons, hull);
    return 1 - share + share * (count - corners) / area * disc_area / count;
  }

  static int count_inside_corners(const PlanePoints& photons, const std::vector<Point2>& hull) {
    int corners = 0;
    for (int i = 0; i < photons.size(); ++i) {
      const Vec2 p = photons[i];
      const auto is_here = [&](Point2 c) { return c.x == p.x && c.y == p.y; };
      if (photons.inside()[i] > 0 && std::any_of(hull.begin(), hull.end(), is_here)) ++corners;
    }
    return corners;
  }

  double published(const GatherPoint& at, const PhotonMap& map, const Disc& disc) const {
    thread_local PlanePoints photons;
    project_inner_photons(at, map, disc, photons);
    std::vector<Point2> points;
    for (int i = 0; i < photons.size(); ++i) points.push_back({photons[i].x, photons[i].y});
    const double area = polygon_area(convex_hull(points), std::numeric_limits<double>::infinity());
    const double disc_area = static_cast<double>(kPi) * disc.h2 / disc.r2;
    return area > kDegenerate * disc_area ? disc_area / area : 1;
  }

  EstimatorConfig config_;
};

}  // namespace

std::unique_ptr<Estimator> make_hull(const EstimatorConfig& config) {
  return std::make_unique<Hull>(config);
}

}  // namespace octolux
