// The free region R around a query: a part of the tangent plane on which there is surface, all of
// it on the query's side of every wall that was seen. Known from geometry alone, not from photons.
//
// Eight feelers cut the plane into sectors. Each feeler ends at a wall or at a free edge, whose
// line in the tangent plane is known exactly, or is open. In the sector between two feelers R is
// the intersection of what both say. That is exact for a wall, a strip and a room's corner at any
// angle; around a pillar or a wall's end it is too small, which is harmless: a density is unbiased
// on any part of the free surface, and only too large a part leaks. Where two neighbours disagree,
// one more feeler (and probe) is sent to the farthest point of the sector they leave; if that ends
// early too, there is a third wall between them: its half plane counts as well, and R is cut back
// to the chord of the feelers' ends, which never leaves a convex room. What no ray meets is not
// known: an obstacle or hole seen under less than 45 degrees may be missed; the random turn makes
// that vary. Paper: Tobler & Maierhofer 2006, section 4. Pure functions; thread-safe.
#pragma once

#include <span>

#include "accel/photon_region.h"
#include "estimators/feelers.h"

namespace octolux {

class FreeRegion {
 public:
  /// The whole plane.
  explicit FreeRegion(Vec3 normal);
  /// What the feelers find.
  FreeRegion(const RayCaster& caster, const FeelerQuery& query);

  const PhotonRegion& photons() const { return region_; }
  /// R is known up to this distance [m].
  float reach() const { return reach_; }
  /// No boundary is closer than this [m].
  float clearance() const { return region_.clearance; }

  /// Nothing of R is farther than this [m], if that is less than the reach; infinite if not.
  float extent() const;
  /// Integral over R and the disc of radius h of 1 - taper d^2/h^2 [m^2].
  double integral(float h, float taper) const;
  /// Area of what R, the disc of radius h and an OctoBox have in common [m^2]. `box`: its distances
  /// (>= 0) along the eight directions at 45 degrees, from the first axis of photons() on.
  double area_in_box(float h, std::span<const float, 8> box) const;

 private:
  void add(int sector, int slot, HalfPlane line);

  PhotonRegion region_;
  float reach_ = kInfinity;
};

/// The paper's filter: the OctoBox (with 4 feelers the box) whose sides are as far away as the
/// feelers in fixed directions got, at right angles to them. No planes, no edges, no turn.
PhotonRegion feeler_box(const RayCaster& caster, const FeelerQuery& query);

}  // namespace octolux
