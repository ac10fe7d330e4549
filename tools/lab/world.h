// One case at one angle: its surfaces as geometry, and its photons, drawn anew for every look-up.
#pragma once

#include <memory>
#include <vector>

#include "accel/ray_caster.h"
#include "core/photon.h"
#include "core/rng.h"
#include "tools/lab/cases.h"

namespace octolux {

enum class PhotonPattern { poisson, low_discrepancy };

/// Immutable, thread-safe. The query is at the origin, its normal +z.
class LabWorld {
 public:
  /// The layout turned by `angle` [degrees] around the query.
  LabWorld(const LabLayout& layout, double angle);

  /// Photons around the query, so dense that n of them are within a distance of about 1, and more
  /// than enough for n to be found on the query's side of the walls.
  std::vector<Photon> photons(int n, PhotonPattern pattern, Rng& rng) const;

  const RayCaster& caster() const { return *caster_; }
  /// Where the query is seen from: above, and leaning over the floor on its side of the walls.
  Vec3 viewer() const { return viewer_; }

 private:
  Vec3 find_viewer() const;
  double irradiance(Point2 p, bool& near) const;
  /// True if it is kept, and on the query's side of the walls.
  bool add_floor_photon(Point2 p, double density, Rng& rng, std::vector<Photon>& photons) const;
  std::vector<Photon> poisson_floor(int n, double density, Rng& rng) const;
  std::vector<Photon> low_discrepancy_floor(int n, double density, Rng& rng) const;
  void add_wall_photons(double density, double reach, Rng& rng, std::vector<Photon>& photons) const;
  Vec3 turned(double x, double y, double z) const;
  Photon photon_on_floor(Point2 p, double flux) const;

  LabLayout layout_;
  double cosine_, sine_;
  double brightest_ = 0;
  double farthest_ = 0;  // photons
  std::vector<Shape> shapes_;
  std::unique_ptr<RayCaster> caster_;
  Vec3 viewer_;
};

}  // namespace octolux
