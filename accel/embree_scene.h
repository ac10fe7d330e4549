// The scene as Embree 3.13 has it; private to ray_caster.cpp. One geometry per shape, its id the
// shape's index. Meshes are Embree's triangles, quadrics are user geometries that call
// core/shape.h's intersect(). A group is an Embree scene of its own, its geometries numbered within
// the group; an instance of it is a geometry of the main scene, numbered behind the shapes. Embree
// reports both numbers; `number` makes one of them.
//
// Vertices are copied, because Embree reads 16 bytes for each of them and the last one of a shared
// array has only 12; indices are shared. Robust mode uses Pluecker coordinates, so a ray between
// two triangles of a common edge hits at least one (Davidovic et al., "3D Rasterization: A Bridge
// between Rasterization and Ray Casting", 2012). Thread-safe after construction.
#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "accel/ray_caster.h"

namespace octolux {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

class EmbreeScene {
 public:
  /// Throws Error if Embree fails (memory).
  EmbreeScene(std::span<const Shape> shapes, std::span<const Instance> instances,
              const RayCaster::BuildProgress& progress);

  RTCScene handle() const { return scene_.get(); }
  const Bounds& bounds() const { return bounds_; }
  std::int64_t memory() const { return memory_; }
  std::span<const PlacedShape> placed() const { return placed_; }

  /// A shape's number in hits (RayHit), from Embree's two.
  std::uint32_t number(unsigned geometry, unsigned instance) const {
    return instance == RTC_INVALID_GEOMETRY_ID
               ? geometry
               : first_of_instance_[instance - shapes_.size()] + geometry;
  }
  /// Which shape has this number, and the instance that places it, or nullptr.
  std::pair<const Shape*, const Instance*> find(std::uint32_t number) const {
    if (number < shapes_.size()) return {&shapes_[number], nullptr};
    const PlacedShape& found = placed_[number - shapes_.size()];
    return {&shapes_[found.shape], &instances_[found.instance]};
  }
  bool has(std::uint32_t number) const { return number < shapes_.size() + placed_.size(); }

 private:
  struct Group {
    Owned<RTCScene> scene;
    std::vector<std::uint32_t> shapes;  // by their number in `scene`
    std::vector<Bounds> bounds;
  };

  void commit(RTCScene scene, const RayCaster::BuildProgress& progress) const;
  void add_shapes();
  void add_to_group(std::uint32_t index, const Bounds& box);
  void add_instance(std::uint32_t index);
  void attach_shape(RTCScene to, const Shape& shape, std::uint32_t id) const;

  std::span<const Shape> shapes_;
  std::span<const Instance> instances_;
  std::vector<PlacedShape> placed_;
  std::vector<std::uint32_t> first_of_instance_;  // number of its first shape
  std::string first_error_;                       // written by the device
  std::atomic<std::int64_t> memory_ = 0;          // [bytes] Embree's own, counted by the device
  Owned<RTCDevice> device_{rtcNewDevice(nullptr)};
  std::vector<Group> groups_;
  Owned<RTCScene> scene_;
  Bounds bounds_;
};

}  // namespace octolux
