// RayCaster over Embree 3.13: one geometry per shape, its id the shape's index. Meshes are Embree's
// triangles, quadrics are user geometries that call core/shape.h's intersect().
//
// Vertices are copied, because Embree reads 16 bytes for each of them and the last one of a shared
// array has only 12; indices are shared. Robust mode uses Pluecker coordinates, so a ray between
// two triangles of a common edge hits at least one (Davidovic et al., "3D Rasterization: A Bridge
// between Rasterization and Ray Casting", 2012). Thread-safe after construction.
#include "accel/ray_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <string>

#include "core/check.h"
#include "core/error.h"

namespace octolux {
namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

void record_error(void* first_error, RTCError, const char* message) {
  auto& text = *static_cast<std::string*>(first_error);
  if (text.empty()) text = message;
}

RTCRay to_embree(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = ray.t_min;
  r.tfar = ray.t_max;
  r.mask = ~0u;
  return r;
}

const Quadric& quadric_of(void* shape) {
  return std::get<Quadric>(static_cast<const Shape*>(shape)->geometry);
}

std::optional<QuadricHit> intersect_quadric(void* shape, const RTCRay& r) {
  return intersect(quadric_of(shape), {r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z},
                   r.tnear, r.tfar);
}

void quadric_bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds box = bounds(*static_cast<const Shape*>(args->geometryUserPtr));
  *args->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0,
                     box.upper.x, box.upper.y, box.upper.z, 0};
}

/// The hit's normal, which nobody reads, carries the object position.
void quadric_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto hit = intersect_quadric(args->geometryUserPtr, query.ray);
  if (!hit) return;
  query.ray.tfar = hit->t;
  query.hit.Ng_x = hit->position.x;
  query.hit.Ng_y = hit->position.y;
  query.hit.Ng_z = hit->position.z;
  query.hit.u = query.hit.v = 0;
  query.hit.primID = args->primID;
  query.hit.geomID = args->geomID;
  query.hit.instID[0] = args->context->instID[0];
}

void quadric_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  if (intersect_quadric(args->geometryUserPtr, ray)) ray.tfar = -kInfinity;
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
  Owned<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
  rtcSetGeometryUserData(geometry.get(), const_cast<Shape*>(&shape));
  rtcSetGeometryBoundsFunction(geometry.get(), quadric_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), quadric_intersect);
  rtcSetGeometryOccludedFunction(geometry.get(), quadric_occluded);
  return geometry;
}

}  // namespace

struct RayCaster::Impl {
  std::span<const Shape> shapes;
  std::string first_error;
  Owned<RTCDevice> device{rtcNewDevice(nullptr)};
  Owned<RTCScene> scene;
  Bounds bounds;

  void add(std::uint32_t index) {
    const Shape& shape = shapes[index];
    const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
    if (mesh && mesh->triangles.empty()) return;
    const auto geometry =
        mesh ? make_triangles(device.get(), *mesh) : make_user_geometry(device.get(), shape);
    rtcSetGeometryBuildQuality(geometry.get(), RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene.get(), geometry.get(), index);
    bounds.add(octolux::bounds(shape));
  }
};

RayCaster::RayCaster(std::span<const Shape> shapes) : impl_(std::make_unique<Impl>()) {
  Impl& impl = *impl_;
  OCTOLUX_CHECK(impl.device != nullptr);
  rtcSetDeviceErrorFunction(impl.device.get(), record_error, &impl.first_error);
  impl.shapes = shapes;
  impl.scene.reset(rtcNewScene(impl.device.get()));
  rtcSetSceneFlags(impl.scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl.scene.get(), RTC_BUILD_QUALITY_HIGH);
  for (std::uint32_t i = 0; i < shapes.size(); ++i) impl.add(i);
  rtcCommitScene(impl.scene.get());
  if (!impl.first_error.empty()) throw Error("Embree: " + impl.first_error);
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;

std::optional<RayHit> RayCaster::closest(const Ray& ray) const {
  RTCRayHit query;
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene.get(), &context, &query);
  const RTCHit& hit = query.hit;
  if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{query.ray.tfar, hit.geomID, hit.primID,
                hit.u,          hit.v,      {hit.Ng_x, hit.Ng_y, hit.Ng_z}};
}

bool RayCaster::occluded(const Ray& ray) const {
  RTCRay query = to_embree(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene.get(), &context, &query);
  return query.tfar < 0;
}

SurfacePoint RayCaster::surface(const RayHit& hit) const {
  const auto& geometry = impl_->shapes[hit.shape].geometry;
  const auto* mesh = std::get_if<TriangleMesh>(&geometry);
  SurfacePoint point = mesh ? surface_point(*mesh, hit.primitive, hit.u, hit.v)
                            : surface_point(std::get<Quadric>(geometry), hit.object_position);
  point.shape = hit.shape;
  return point;
}

Bounds RayCaster::bounds() const { return impl_->bounds; }

}  // namespace octolux
