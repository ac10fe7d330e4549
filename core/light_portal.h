// Portals: openings through which light from infinitely far away (sun, sky, environment) comes into
// a room. They are marked in the scene, are no surfaces, and change nothing but where photons are
// aimed: a share of an infinite light's photons pass a uniform point of the portals, in a direction
// that the light chooses, the others are emitted as ever. Both kinds are weighed as one-sample
// multiple importance sampling with the balance heuristic (Veach 1997, 9.2.4), so portals that miss
// a window cost time, not truth; no photon carries more than 1 / (1 - kPortalShare) of what it
// carried without them.
#pragma once

#include <memory>
#include <vector>

#include "core/distribution.h"
#include "core/light.h"
#include "core/vec3d.h"

namespace octolux {

/// Immutable, so thread-safe.
class Portals {
 public:
  /// Meshes in world space, of positive area together.
  explicit Portals(const std::vector<TriangleMesh>& meshes);

  struct Point {
    Vec3 position;
    int triangle = 0;
  };
  /// Uniform by area.
  Point sample(Vec2 u) const;
  /// Density [m^-2] of sampled points' shadows on a plane at right angles to `direction`, where the
  /// line through `position` crosses it. `triangle`, if not negative, is known to be on that line.
  double line_density(Vec3 position, Vec3 direction, int triangle = -1) const;
  double area() const { return triangles_.total(); }  // [m^2]

 private:
  struct Triangle {
    Vec3d corner, u, v;  // u, v: edges from the corner
    Vec3d normal;        // as long as twice the area
  };
  std::vector<Triangle> corners_;
  Distribution1D triangles_;  // by area
};

/// Share of an infinite light's photons that are aimed at portals.
inline constexpr float kPortalShare = 0.5f;

/// The same infinite light, its photons aimed at `portals`, which must outlive it.
std::unique_ptr<Light> aim_at_portals(std::unique_ptr<Light> light, const Portals& portals);

}  // namespace octolux
