// Where a pass keeps what is the same for many rays near one another (records), and which record
// serves which point.
//
// Sites are where the photons of a second photon pass land: where light is, so close together where
// the bandwidth is narrow. Those photons take part in no estimate. A record at a photon of the map
// itself would find that photon at distance 0, and one found by leaving it out would know that no
// other is between it and the point that asks: both are biased by about 1/n at every number of
// passes. For the same reason, which record serves a point, and whether it is near enough, is
// decided by the sites alone. "Near enough" shrinks with the bandwidth from pass to pass, so a
// render converges to the same picture with records and without.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "accel/photon_tree.h"
#include "core/photon.h"
#include "estimators/estimator.h"

namespace octolux {

/// Photon paths that make the sites of a map of `photons` paths: a fifth of them in the first pass,
/// and so many later that the reach of each holds five, as then, and is about a bandwidth.
std::int64_t record_paths(std::int64_t photons, const Bandwidth& bandwidth);

/// Immutable, thread-safe.
class RecordSites {
 private:
  struct Site {
    Vec3 ng, ns;      // normals on the side the light came from
    float error = 0;  // [m] bound on the error of the position
  };

 public:
  static constexpr double kBytesPerSite = sizeof(Site) + PhotonTree::kBytesPerItem;

  RecordSites() = default;
  /// One record for each photon, those that are not finite left out. Each serves points within the
  /// share `reuse` of the bandwidth that a look-up for `neighbours` sites would have.
  RecordSites(const std::vector<Photon>& photons, const Bandwidth& bandwidth, int neighbours,
              double reuse);

  std::size_t size() const { return sites_.size(); }
  /// A record, and how far it is from a query [m^2], squared, in the query's squashed metric.
  struct Found {
    std::uint32_t record = 0;
    float distance2 = 0;
  };
  /// The record nearest to a query on a surface that faces the same way, shading normals included.
  /// It serves the query if it is nearer than its reach.
  std::optional<Found> find(const PhotonQuery& query, Vec3 shading_normal) const;
  /// How far a record serves [m], by the distances of the sites around it. As expensive as a
  /// look-up.
  float reach(std::uint32_t record) const;
  /// The surface at a record, its front side where the light came from.
  SurfacePoint point(std::uint32_t record) const;

 private:
  PhotonTree tree_;
  std::vector<Site> sites_;  // in the tree's order
  float scale_ = 0;          // of reaches: distances between sites over this
  float max_reach_ = 0;      // [m]
};

}  // namespace octolux
