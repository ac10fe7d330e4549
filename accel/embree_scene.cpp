// embree_scene.h: geometries made of shapes, and how Embree meets quadrics. Embree builds with
// threads of its own, which call back from here: what ThreadSanitizer has to know of them, it is
// told.
#include "accel/embree_scene.h"

#include <algorithm>
#include <array>

#include "core/check.h"
#include "core/error.h"
#include "core/fork_join.h"

namespace octolux {
namespace {

void record_error(void* first_error, RTCError, const char* message) {
  auto& text = *static_cast<std::string*>(first_error);
  if (text.empty()) text = message;
}

bool count_memory(void* total, ssize_t bytes, bool) {
  happens_after(total);
  *static_cast<std::atomic<std::int64_t>*>(total) += bytes;
  return true;  // go on
}

const Quadric& quadric_of(void* shape) {
  return std::get<Quadric>(static_cast<const Shape*>(shape)->geometry);
}

void quadric_bounds(const RTCBoundsFunctionArguments* args) {
  happens_after(args->geometryUserPtr);
  const Bounds box = bounds(*static_cast<const Shape*>(args->geometryUserPtr));
  *args->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0,
                     box.upper.x, box.upper.y, box.upper.z, 0};
}

std::optional<QuadricHit> intersect_quadric(void* shape, RTCRayN* ray, unsigned n, unsigned i) {
  const Vec3 origin{RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i), RTCRayN_org_z(ray, n, i)};
  const Vec3 direction{RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i),
                       RTCRayN_dir_z(ray, n, i)};
  return intersect(quadric_of(shape), origin, direction, RTCRayN_tnear(ray, n, i),
                   RTCRayN_tfar(ray, n, i));
}

/// The hit's normal, which nobody reads, carries the object position.
void quadric_intersect(const RTCIntersectFunctionNArguments* args) {
  const unsigned n = args->N;
  RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* record = RTCRayHitN_HitN(args->rayhit, n);
  for (unsigned i = 0; i < n; ++i) {
    if (!args->valid[i]) continue;
    const auto hit = intersect_quadric(args->geometryUserPtr, ray, n, i);
    if (!hit) continue;
    RTCRayN_tfar(ray, n, i) = hit->t;
    RTCHitN_Ng_x(record, n, i) = hit->position.x;
    RTCHitN_Ng_y(record, n, i) = hit->position.y;
    RTCHitN_Ng_z(record, n, i) = hit->position.z;
    RTCHitN_u(record, n, i) = RTCHitN_v(record, n, i) = 0;
    RTCHitN_primID(record, n, i) = args->primID;
    RTCHitN_geomID(record, n, i) = args->geomID;
    RTCHitN_instID(record, n, i, 0) = args->context->instID[0];
  }
}

void quadric_occluded(const RTCOccludedFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    if (intersect_quadric(args->geometryUserPtr, args->ray, args->N, i)) {
      RTCRayN_tfar(args->ray, args->N, i) = -kInfinity;
    }
  }
}

Owned<RTCGeometry> make_triangles(RTCDevice device, const TriangleMesh& mesh) {
  static_assert(sizeof(Vec3) == 12 && sizeof(mesh.triangles[0]) == 12);
  Owned<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  void* vertices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0,
                                           RTC_FORMAT_FLOAT3, 12, mesh.positions.size());
  if (vertices == nullptr) throw Error("out of memory for the scene's vertices");
  std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Vec3*>(vertices));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, 12, mesh.triangles.size());
  return geometry;
}

Owned<RTCGeometry> make_user_geometry(RTCDevice device, const Shape& shape) {
  happens_before(&shape);
  Owned<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
  rtcSetGeometryUserData(geometry.get(), const_cast<Shape*>(&shape));
  rtcSetGeometryBoundsFunction(geometry.get(), quadric_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), quadric_intersect);
  rtcSetGeometryOccludedFunction(geometry.get(), quadric_occluded);
  return geometry;
}

RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  return scene;
}

}  // namespace

EmbreeScene::EmbreeScene(std::span<const Shape> shapes, std::span<const Instance> instances,
                         const RayCaster::BuildProgress& progress)
    : shapes_(shapes), instances_(instances) {
  OCTOLUX_CHECK(device_ != nullptr);
  rtcSetDeviceErrorFunction(device_.get(), record_error, &first_error_);
  happens_before(&memory_);
  rtcSetDeviceMemoryMonitorFunction(device_.get(), count_memory, &memory_);
  scene_.reset(new_scene(device_.get()));
  add_shapes();
  for (const Group& group : groups_) {
    if (group.scene) commit(group.scene.get(), progress);
  }
  for (std::uint32_t i = 0; i < instances.size(); ++i) add_instance(i);
  commit(scene_.get(), progress);
  if (!first_error_.empty()) throw Error("Embree: " + first_error_);
}

void EmbreeScene::commit(RTCScene scene, const RayCaster::BuildProgress& progress) const {
  struct Build {
    const RayCaster::BuildProgress& progress;
    ForkJoin work;
  } build{progress, {}};
  const auto report = [](void* to, double share) {
    const auto* of = static_cast<const Build*>(to);
    const ForkJoin::Task task(of->work);
    of->progress(share);
    return true;  // go on
  };
  if (progress) rtcSetSceneProgressMonitorFunction(scene, report, &build);
  rtcCommitScene(scene);
  if (progress) rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
  happens_after(&memory_);
}

void EmbreeScene::attach_shape(RTCScene to, const Shape& shape, std::uint32_t id) const {
  const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
  if (mesh && mesh->triangles.empty()) return;
  const auto geometry =
      mesh ? make_triangles(device_.get(), *mesh) : make_user_geometry(device_.get(), shape);
  rtcSetGeometryBuildQuality(geometry.get(), RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(to, geometry.get(), id);
}

void EmbreeScene::add_shapes() {
  for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
    const Bounds box = octolux::bounds(shapes_[i]);
    if (shapes_[i].group >= 0) {
      add_to_group(i, box);
      continue;
    }
    attach_shape(scene_.get(), shapes_[i], i);
    bounds_.add(box);
  }
}

void EmbreeScene::add_to_group(std::uint32_t index, const Bounds& box) {
  const auto number = static_cast<std::size_t>(shapes_[index].group);
  if (groups_.size() <= number) groups_.resize(number + 1);
  Group& group = groups_[number];
  if (!group.scene) group.scene.reset(new_scene(device_.get()));
  attach_shape(group.scene.get(), shapes_[index], static_cast<std::uint32_t>(group.shapes.size()));
  group.shapes.push_back(index);
  group.bounds.push_back(box);
}

void EmbreeScene::add_instance(std::uint32_t index) {
  const Instance& instance = instances_[index];
  const Group& group = groups_.at(static_cast<std::size_t>(instance.group));
  const std::size_t first = shapes_.size() + placed_.size();
  OCTOLUX_CHECK(first + group.shapes.size() < RTC_INVALID_GEOMETRY_ID);
  first_of_instance_.push_back(static_cast<std::uint32_t>(first));
  for (const std::uint32_t shape : group.shapes) placed_.push_back({shape, index});
  for (const Bounds& box : group.bounds) bounds_.add(place(box, instance.to_world));

  const Owned<RTCGeometry> geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(geometry.get(), group.scene.get());
  std::array<float, 12> rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = static_cast<float>(instance.to_world.m[i / 4][i % 4]);
  }
  rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, rows.data());
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene_.get(), geometry.get(),
                        static_cast<std::uint32_t>(shapes_.size()) + index);
}

}  // namespace octolux
