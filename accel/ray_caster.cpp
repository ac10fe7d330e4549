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

void quadric_bounds(const RTCBoundsFunctionArguments* args) {
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

RTCRayHit8 to_embree(const RayPacket& packet) {
  RTCRayHit8 query{};
  RTCRay8& r = query.ray;
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const Ray& ray = packet.rays[i];
    r.org_x[i] = ray.origin.x, r.org_y[i] = ray.origin.y, r.org_z[i] = ray.origin.z;
    r.dir_x[i] = ray.direction.x, r.dir_y[i] = ray.direction.y, r.dir_z[i] = ray.direction.z;
    r.tnear[i] = ray.t_min;
    r.tfar[i] = ray.t_max;
    r.mask[i] = ~0u;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  return query;
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

std::array<PacketHit, RayPacket::kSize> RayCaster::closest_hits(const RayPacket& packet) const {
  constexpr int kSize = RayPacket::kSize;
  alignas(32) std::array<int, kSize> valid;
  for (int i = 0; i < kSize; ++i) valid[i] = (packet.active >> i & 1) ? -1 : 0;
  RTCRayHit8 query = to_embree(packet);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect8(valid.data(), impl_->scene.get(), &context, &query);
  std::array<PacketHit, kSize> hits;
  const RTCHit8& hit = query.hit;
  for (int i = 0; i < kSize; ++i) {
    if (!valid[i] || hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const Vec3 record{hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]};
    const auto* quadric = std::get_if<Quadric>(&impl_->shapes[hit.geomID[i]].geometry);
    Vec3 normal = quadric ? surface_point(*quadric, record).ng : normalize(record);
    if (dot(normal, packet.rays[i].direction) > 0) normal = -normal;
    hits[i] = {query.ray.tfar[i], normal, hit.geomID[i], hit.primID[i]};
  }
  return hits;
}

void RayCaster::visit_near(Vec3 p, float radius, NearFunction function, void* visitor) const {
  struct Visit {
    const Shape* shapes;
    NearFunction function;
    void* visitor;
  } visit{impl_->shapes.data(), function, visitor};
  const auto show = [](RTCPointQueryFunctionArguments* args) {
    const Visit& v = *static_cast<const Visit*>(args->userPtr);
    const auto* mesh = std::get_if<TriangleMesh>(&v.shapes[args->geomID].geometry);
    bool more = true;
    if (mesh != nullptr) {
      const auto& corner = mesh->triangles[args->primID];
      const Vec3* at = mesh->positions.data();
      const NearTriangle triangle{std::uint64_t{args->geomID} << 32 | args->primID, at[corner[0]],
                                  at[corner[1]], at[corner[2]]};
      more = v.function(v.visitor, &triangle);
    } else {
      more = v.function(v.visitor, nullptr);
    }
    if (!more) args->query->radius = 0;
    return !more;
  };
  RTCPointQuery query{p.x, p.y, p.z, 0, radius};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl_->scene.get(), &query, &context, show, &visit);
}

std::optional<std::array<Vec3, 3>> RayCaster::triangle(std::uint32_t shape,
                                                       std::uint32_t primitive) const {
  if (shape >= impl_->shapes.size()) return std::nullopt;
  const auto* mesh = std::get_if<TriangleMesh>(&impl_->shapes[shape].geometry);
  if (mesh == nullptr || primitive >= mesh->triangles.size()) return std::nullopt;
  const auto& corner = mesh->triangles[primitive];
  return std::array{mesh->positions[corner[0]], mesh->positions[corner[1]],
                    mesh->positions[corner[2]]};
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
