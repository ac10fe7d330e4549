// Rays against the scene's shapes. With embree_scene.h the sole user of Embree (3.13), so all that
// a change of ray tracer touches. Finds, never shades.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "core/instance.h"
#include "core/ray.h"
#include "core/shape.h"

namespace octolux {

/// Where a ray met a shape. Shapes are numbered as in the list given to the ray caster; the shapes
/// of instances, each on its own, follow behind (RayCaster::placed).
struct RayHit {
  float t = 0;
  std::uint32_t shape = 0;
  std::uint32_t primitive = 0;
  float u = 0, v = 0;    // barycentrics (meshes)
  Vec3 object_position;  // on the unit shape (quadrics)
};

/// Eight rays for one call. Lanes whose bit in `active` is 0 are not traced.
struct RayPacket {
  static constexpr int kSize = 8;
  std::array<Ray, kSize> rays;
  std::uint32_t active = 0;
};

/// Where a ray of a packet met a shape: less than RayHit, and cheaper to have.
struct PacketHit {
  float t = kInfinity;  // infinite: nothing hit
  Vec3 normal;          // geometric, unit, towards the ray's origin
  std::uint32_t shape = 0;
  std::uint32_t primitive = 0;
  bool hit() const { return t < kInfinity; }
};

/// A shape, and the instance that places it.
struct PlacedShape {
  std::uint32_t shape = 0;     // in the list of shapes
  std::uint32_t instance = 0;  // in the list of instances
};

/// A primitive near a point.
struct NearPrimitive {
  std::uint64_t id = 0;
  std::array<Vec3, 3> corners;  // of a triangle
  bool triangle = true;         // false: all that is known is that it is not nearer than
  float distance = 0;           // this [m]
};
/// Notes one on `visitor`, and says how far to look from now on [m]. A pointer to a function,
/// because it is called for all that is near.
using NearFunction = float (*)(void* visitor, const NearPrimitive& primitive);

/// Thread-safe after construction. Uses Embree's robust mode: edges shared by triangles are
/// watertight, because a ray slipping between two walls is a light leak. (Vertices are so up to
/// rounding: of rays aimed at one exactly, a few in a thousand pass.)
class RayCaster {
 public:
  /// Told the share in [0, 1] that is done while building, from any thread. May be empty.
  using BuildProgress = std::function<void(double)>;

  /// Both lists must outlive the caster and stay where they are. Shapes of a group are only met
  /// where an instance places them.
  explicit RayCaster(std::span<const Shape> shapes, std::span<const Instance> instances = {},
                     const BuildProgress& progress = {});
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;

  /// Closest hit with t in (t_min, t_max).
  std::optional<RayHit> closest(const Ray& ray) const;
  /// Is anything hit at t in (t_min, t_max)?
  bool occluded(const Ray& ray) const;
  /// Closest hits of the active lanes.
  std::array<PacketHit, RayPacket::kSize> closest_hits(const RayPacket& packet) const;
  /// Shows the primitives that come nearer to `p` than `radius` [m], and others; one may come
  /// twice.
  void visit_near(Vec3 p, float radius, NearFunction function, void* visitor) const;
  /// Corners of a primitive that is a triangle.
  std::optional<std::array<Vec3, 3>> triangle(std::uint32_t shape, std::uint32_t primitive) const;
  /// The surface at a hit.
  SurfacePoint surface(const RayHit& hit) const;
  /// Sets dp_du and dp_dv of what `surface` returned.
  void add_tangents(const RayHit& hit, SurfacePoint& point) const;

  /// The shapes of instances: number i here is number shapes.size() + i in hits.
  std::span<const PlacedShape> placed() const;
  Bounds bounds() const;
  /// Memory [bytes] besides the lists given.
  std::int64_t memory() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace octolux
