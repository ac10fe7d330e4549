// Rays against the scene's shapes. The sole user of Embree (3.13), so the only file that a change
// of ray tracer touches. Finds, never shades.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/ray.h"
#include "core/shape.h"

namespace octolux {

/// Where a ray met a shape.
struct RayHit {
  float t = 0;
  std::uint32_t shape = 0;
  std::uint32_t primitive = 0;
  float u = 0, v = 0;    // barycentrics (meshes)
  Vec3 object_position;  // on the unit shape (quadrics)
};

/// Thread-safe after construction. Uses Embree's robust mode: edges shared by triangles are
/// watertight, because a ray slipping between two walls is a light leak. (Vertices are so up to
/// rounding: of rays aimed at one exactly, a few in a thousand pass.)
class RayCaster {
 public:
  /// `shapes` must outlive the caster and stay where they are.
  explicit RayCaster(std::span<const Shape> shapes);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;

  /// Closest hit with t in (t_min, t_max).
  std::optional<RayHit> closest(const Ray& ray) const;
  /// Is anything hit at t in (t_min, t_max)?
  bool occluded(const Ray& ray) const;
  /// The surface at a hit.
  SurfacePoint surface(const RayHit& hit) const;

  Bounds bounds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace octolux
