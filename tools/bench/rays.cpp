// Share of Embree's bare ray rate that RayCaster keeps: the same recorded rays, in a box like
// Cornell's, through rtcIntersect1 with nothing else and through RayCaster. One ray is one
// iteration. The only benchmark that includes Embree.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <vector>

#include "accel/ray_caster.h"
#include "core/frame.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

constexpr std::size_t kRays = 1 << 16;

/// Appends the six faces of a box from `lower` to `upper`, turned by `angle` about y.
void add_box(TriangleMesh& mesh, Vec3 lower, Vec3 upper, float angle) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 center = (lower + upper) * 0.5f;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y,
                      i & 4 ? upper.z : lower.z};
    const Vec3 d = corner - center;
    mesh.positions.push_back({center.x + d.x * std::cos(angle) - d.z * std::sin(angle), corner.y,
                              center.z + d.x * std::sin(angle) + d.z * std::cos(angle)});
  }
  static constexpr std::uint32_t kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 2, 6, 4},
                                                 {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({base + f[0], base + f[1], base + f[2]});
    mesh.triangles.push_back({base + f[0], base + f[2], base + f[3]});
  }
}

std::vector<Shape> make_box() {
  TriangleMesh room, blocks;
  add_box(room, {0, 0, 0}, {1, 1, 1}, 0);
  add_box(blocks, {0.2f, 0, 0.2f}, {0.5f, 0.6f, 0.5f}, 0.3f);
  add_box(blocks, {0.55f, 0, 0.5f}, {0.85f, 0.3f, 0.8f}, -0.3f);
  return {{room, -1, -1, "room"}, {blocks, -1, -1, "blocks"}};
}

/// Paths of a camera ray and three diffuse bounces.
std::vector<Ray> record_rays(const RayCaster& caster) {
  std::vector<Ray> rays;
  Rng rng(1, Stream::test, 0, 0);
  while (rays.size() < kRays) {
    const Vec2 at = rng.uniform2();
    Ray ray{{0.5f, 0.5f, 0.01f}, normalize(Vec3{at.x - 0.5f, at.y - 0.5f, 0.7f})};
    for (int bounce = 0; bounce < 4; ++bounce) {
      rays.push_back(ray);
      const auto hit = caster.closest(ray);
      if (!hit) break;
      const SurfacePoint p = caster.surface(*hit);
      const Vec3 n = dot(p.ng, ray.direction) < 0 ? p.ng : -p.ng;
      const Vec3 d = Frame::from_normal(n).to_world(sample_cosine_hemisphere(rng.uniform2()));
      ray = {offset_origin(p.position, n, p.error, d), d};
    }
  }
  rays.resize(kRays);
  return rays;
}

RTCScene make_bare_scene(RTCDevice device, const std::vector<Shape>& shapes) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  for (const Shape& shape : shapes) {
    const auto& mesh = std::get<TriangleMesh>(shape.geometry);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
    std::copy(mesh.positions.begin(), mesh.positions.end(), vertices);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.triangles.data(), 0, 12, mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  return scene;
}

std::vector<RTCRayHit> to_queries(const std::vector<Ray>& rays) {
  std::vector<RTCRayHit> queries(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRayHit& q = queries[i];
    const Ray& r = rays[i];
    q.ray = {
        r.origin.x, r.origin.y, r.origin.z, r.t_min, r.direction.x, r.direction.y, r.direction.z, 0,
        r.t_max,    ~0u,        0,          0};
    q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  }
  return queries;
}

void bare_embree(benchmark::State& state) {
  const std::vector<Shape> shapes = make_box();
  const RayCaster caster(shapes);
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = make_bare_scene(device, shapes);
  std::vector<RTCRayHit> queries = to_queries(record_rays(caster));
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::size_t i = 0;
  for (auto _ : state) {
    RTCRayHit query = queries[i++ % kRays];
    rtcIntersect1(scene, &context, &query);
    benchmark::DoNotOptimize(query);
  }
  state.SetItemsProcessed(state.iterations());
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}

enum class What { closest, surface, occluded };

template <What what>
void ray_caster(benchmark::State& state) {
  const std::vector<Shape> shapes = make_box();
  const RayCaster caster(shapes);
  const std::vector<Ray> rays = record_rays(caster);
  std::size_t i = 0;
  for (auto _ : state) {
    const Ray& ray = rays[i++ % kRays];
    if constexpr (what == What::occluded) {
      benchmark::DoNotOptimize(caster.occluded(ray));
    } else {
      auto hit = caster.closest(ray);
      benchmark::DoNotOptimize(hit);
      if (what == What::surface && hit) benchmark::DoNotOptimize(caster.surface(*hit));
    }
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(bare_embree);
BENCHMARK(ray_caster<What::closest>)->Name("ray_caster_closest");
BENCHMARK(ray_caster<What::surface>)->Name("ray_caster_closest_and_surface");
BENCHMARK(ray_caster<What::occluded>)->Name("ray_caster_occluded");

}  // namespace
}  // namespace octolux

BENCHMARK_MAIN();
