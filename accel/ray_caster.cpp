// RayCaster: rays to Embree and hits back. Embree answers an instance's hit in the group's space
// (normals, the object position of a quadric); only t needs no change. Thread-safe.
#include <algorithm>
#include <array>

#include "accel/embree_scene.h"

namespace octolux {
namespace {

RTCRay to_embree(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = ray.t_min;
  r.tfar = ray.t_max;
  r.mask = ~0u;
  return r;
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

}  // namespace

struct RayCaster::Impl : EmbreeScene {
  using EmbreeScene::EmbreeScene;

  /// Corners of primitive `primitive` of the shape of this number, if it is a triangle.
  std::optional<std::array<Vec3, 3>> corners(std::uint32_t number, std::uint32_t primitive) const {
    const auto [shape, instance] = find(number);
    const auto* mesh = std::get_if<TriangleMesh>(&shape->geometry);
    if (mesh == nullptr || primitive >= mesh->triangles.size()) return std::nullopt;
    const auto& corner = mesh->triangles[primitive];
    const Vec3* at = mesh->positions.data();
    std::array found{at[corner[0]], at[corner[1]], at[corner[2]]};
    if (instance) {
      for (Vec3& p : found) p = instance->to_world.point(p);
    }
    return found;
  }

  NearPrimitive near_primitive(std::uint32_t number, std::uint32_t primitive, Vec3 p) const {
    const auto [shape, instance] = find(number);
    NearPrimitive near;
    near.id = std::uint64_t{number} << 32 | primitive;
    const auto* mesh = std::get_if<TriangleMesh>(&shape->geometry);
    if (mesh != nullptr) {
      for (int i = 0; i < 3; ++i) {
        near.corners[i] = mesh->positions[mesh->triangles[primitive][i]];
        if (instance) near.corners[i] = instance->to_world.point(near.corners[i]);
      }
      return near;
    }
    Bounds box = octolux::bounds(*shape);
    if (instance) box = place(box, instance->to_world);
    near.triangle = false;
    near.distance = length(max(max(box.lower - p, p - box.upper), Vec3{0, 0, 0}));
    return near;
  }
};

RayCaster::RayCaster(std::span<const Shape> shapes, std::span<const Instance> instances,
                     const BuildProgress& progress)
    : impl_(std::make_unique<Impl>(shapes, instances, progress)) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;

std::optional<RayHit> RayCaster::closest(const Ray& ray) const {
  RTCRayHit query;
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->handle(), &context, &query);
  const RTCHit& hit = query.hit;
  if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{query.ray.tfar, impl_->number(hit.geomID, hit.instID[0]),
                hit.primID,     hit.u,
                hit.v,          {hit.Ng_x, hit.Ng_y, hit.Ng_z}};
}

bool RayCaster::occluded(const Ray& ray) const {
  RTCRay query = to_embree(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->handle(), &context, &query);
  return query.tfar < 0;
}

std::array<PacketHit, RayPacket::kSize> RayCaster::closest_hits(const RayPacket& packet) const {
  constexpr int kSize = RayPacket::kSize;
  alignas(32) std::array<int, kSize> valid;
  for (int i = 0; i < kSize; ++i) valid[i] = (packet.active >> i & 1) ? -1 : 0;
  RTCRayHit8 query = to_embree(packet);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect8(valid.data(), impl_->handle(), &context, &query);
  std::array<PacketHit, kSize> hits;
  const RTCHit8& hit = query.hit;
  for (int i = 0; i < kSize; ++i) {
    if (!valid[i] || hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const Vec3 record{hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]};
    const std::uint32_t number = impl_->number(hit.geomID[i], hit.instID[0][i]);
    const auto [shape, instance] = impl_->find(number);
    const auto* quadric = std::get_if<Quadric>(&shape->geometry);
    Vec3 normal = quadric ? surface_point(*quadric, record).ng : normalize(record);
    if (instance) normal = normalize(Affine::normal(instance->to_object, normal));
    if (dot(normal, packet.rays[i].direction) > 0) normal = -normal;
    hits[i] = {query.ray.tfar[i], normal, number, hit.primID[i]};
  }
  return hits;
}

void RayCaster::visit_near(Vec3 p, float radius, NearFunction function, void* visitor) const {
  struct Visit {
    const Impl& scene;
    Vec3 p;
    NearFunction function;
    void* visitor;
  } visit{*impl_, p, function, visitor};
  const auto show = [](RTCPointQueryFunctionArguments* args) {
    const Visit& v = *static_cast<const Visit*>(args->userPtr);
    const RTCPointQueryContext& stack = *args->context;
    const unsigned placed_by = stack.instStackSize > 0 ? stack.instID[0] : RTC_INVALID_GEOMETRY_ID;
    const std::uint32_t number = v.scene.number(args->geomID, placed_by);
    const float from = args->query->radius;
    const float to = v.function(v.visitor, v.scene.near_primitive(number, args->primID, v.p));
    args->query->radius = std::min(from, to);
    return to < from;
  };
  RTCPointQuery query{p.x, p.y, p.z, 0, radius};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl_->handle(), &query, &context, show, &visit);
}

std::optional<std::array<Vec3, 3>> RayCaster::triangle(std::uint32_t shape,
                                                       std::uint32_t primitive) const {
  return impl_->has(shape) ? impl_->corners(shape, primitive) : std::nullopt;
}

SurfacePoint RayCaster::surface(const RayHit& hit) const {
  const auto [shape, instance] = impl_->find(hit.shape);
  const auto* mesh = std::get_if<TriangleMesh>(&shape->geometry);
  SurfacePoint point = mesh
                           ? surface_point(*mesh, hit.primitive, hit.u, hit.v)
                           : surface_point(std::get<Quadric>(shape->geometry), hit.object_position);
  if (instance) point = place(point, *instance);
  point.shape = hit.shape;
  return point;
}

void RayCaster::add_tangents(const RayHit& hit, SurfacePoint& point) const {
  const auto [shape, instance] = impl_->find(hit.shape);
  const auto* mesh = std::get_if<TriangleMesh>(&shape->geometry);
  const Tangents t = mesh ? tangents(*mesh, hit.primitive)
                          : tangents(std::get<Quadric>(shape->geometry), hit.object_position);
  point.dp_du = instance ? instance->to_world.vector(t.dp_du) : t.dp_du;
  point.dp_dv = instance ? instance->to_world.vector(t.dp_dv) : t.dp_dv;
}

std::span<const PlacedShape> RayCaster::placed() const { return impl_->placed(); }

std::int64_t RayCaster::memory() const { return impl_->memory(); }

Bounds RayCaster::bounds() const { return impl_->bounds(); }

}  // namespace octolux
