// Where a pass keeps what is the same for many rays near one another (records), which record serves
// which point, and where the surface is a detail too small for look-ups.
//
// Where sites are is told in record_pass.h, and how far each serves by the photons of a second
// photon pass: they lie close together where the bandwidth is narrow. Those photons take part in no
// estimate. A record at a photon of the map itself would find that photon at distance 0, and one
// found by leaving it out would know that no other is between it and the point that asks: both are
// biased by about 1/n at every number of passes. For the same reason, which record serves a point,
// and whether it is near enough, is decided without the map. "Near enough" shrinks from pass to
// pass, faster than the bandwidth, so a render converges to the same picture with records and
// without, and sharing, which brings most while the noise is high, does not outlast it as a bias.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "accel/photon_tree.h"
#include "core/photon.h"
#include "estimators/estimator.h"

namespace octolux {

/// A place for a record: a surface, from the side that is lit or looked at.
struct RecordSite {
  Vec3 position;    // [m]
  Vec3 ng, ns;      // geometric and shading normal on that side
  float error = 0;  // [m] bound on the error of the position
};

/// Immutable, thread-safe.
class RecordSites {
 private:
  struct Surface {
    Vec3 ng, ns;
    float error = 0;
  };

 public:
  static constexpr double kBytesPerSite = sizeof(Surface) + PhotonTree::kBytesPerItem;
  static constexpr double kBytesPerPhoton = sizeof(Vec3) + PhotonTree::kBytesPerItem;

  RecordSites() = default;
  /// One record for each site. Each serves points within a share of the radius that holds
  /// `neighbours` of the photons: reuse s^1.5, s being the bandwidth's shrink factor. Sites and
  /// photons that are not finite are left out.
  RecordSites(const std::vector<RecordSite>& sites, const std::vector<Photon>& photons,
              const Bandwidth& bandwidth, int neighbours, double reuse);

  std::size_t size() const { return surfaces_.size(); }
  /// A record, and how far it is from a query [m^2], squared, in the query's squashed metric.
  struct Found {
    std::uint32_t record = 0;
    float distance2 = 0;
  };
  /// The record nearest to a query on a surface that faces the same way, shading normals included.
  /// It serves the query if it is nearer than its reach.
  std::optional<Found> find(const PhotonQuery& query, Vec3 shading_normal) const;
  /// How far it is [m] from a point to the few photons next to it on surfaces that face the same
  /// way. As expensive as a look-up.
  float spacing(Vec3 position, Vec3 normal) const;
  /// How far a record with this spacing serves [m].
  float reach(float spacing) const { return reach_ * spacing; }
  /// Is the surface at a point with this spacing a detail, so small that as many photons of
  /// surfaces across it are near? Such are window bars, cornices, leaves. A look-up there reaches
  /// over gaps where no photon can land: it found half the light of a house's window frames.
  bool is_detail(Vec3 position, Vec3 normal, float spacing) const;
  /// The surface at a record, its front side that of the site.
  SurfacePoint point(std::uint32_t record) const;

 private:
  class Closest;
  template <class Counts>
  void look_around(const PhotonQuery& query, FacingSet facing, Closest& nearest,
                   const Counts& counts) const;

  PhotonTree sites_;
  std::vector<Surface> surfaces_;  // in the tree's order
  PhotonTree photons_;
  std::vector<Vec3> normals_;  // of the photons' surfaces, in the tree's order
  float reach_ = 0;            // by spacing
  float max_spacing_ = 0;      // [m]
};

}  // namespace octolux
