// What a frame costs and where its time goes, as one table:
//
//   build/bench_render [CORNELL.xml [TWO_ROOMS.xml]]     (default: the shipped scenes)
//
// Path samples and photons per second, bytes per stored photon, the share of Embree's bare ray rate
// the path tracer reaches on its own rays, the split of a photon-mapped frame, and relMSE of photon
// mapping against path tracing at equal time. Figures are medians of several runs within this one
// process; compare ratios, machines are noisy.
#include "renderer/render.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nanoflann.hpp>

#include "core/error.h"
#include "core/parallel.h"
#include "renderer/path_pass.h"
#include "renderer/pixels.h"
#include "renderer/scene_loader.h"
#include "tools/bench/measuring.h"

namespace octolux {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

RenderResult run(const Scene& scene, const RenderConfig& config) {
  Silent observer;
  return render(scene, config, observer);
}

RenderConfig path_for(int passes, double seconds = 0, std::uint64_t seed = 1) {
  RenderConfig config;
  config.integrator = Integrator::path;
  config.seed = seed;
  config.stop = {passes, 0, seconds, 0};
  return config;
}

void report_path_rate(const Scene& scene) {
  std::vector<double> rates;
  for (int i = 0; i < 5; ++i) {
    const RenderResult r = run(scene, path_for(8));
    const double samples = 8.0 * scene.film.crop_width * scene.film.crop_height;
    rates.push_back(samples / r.progress.seconds);
  }
  // Mitsuba 0.6 `path`, Cornell box 256x256, 64 samples in 5.5 s on two cores.
  const double mitsuba = 64.0 * 256 * 256 / 5.5;
  fmt::print(
      "path tracer, Cornell          {:8.2f} M samples/s   {:.2f} x Mitsuba 0.6 path's 0.76\n",
      median(rates) / 1e6, median(rates) / mitsuba);
}

/// Seconds to cast `rays` through Embree and nothing else.
double cast_bare(RTCScene scene, const std::vector<Tracer::LoggedRay>& rays) {
  const double start = now();
  for (const Tracer::LoggedRay& logged : rays) {
    const Ray& r = logged.ray;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const RTCRay ray{
        r.origin.x, r.origin.y, r.origin.z, r.t_min, r.direction.x, r.direction.y, r.direction.z, 0,
        r.t_max,    ~0u,        0,          0};
    if (logged.shadow) {
      RTCRay shadow = ray;
      rtcOccluded1(scene, &context, &shadow);
    } else {
      RTCRayHit hit{ray, {}};
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &hit);
    }
  }
  return now() - start;
}

/// All meshes of the scene in a scene of Embree's own (quadrics left out).
RTCScene bare_scene(RTCDevice device, const Scene& scene) {
  RTCScene out = rtcNewScene(device);
  rtcSetSceneFlags(out, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(out, RTC_BUILD_QUALITY_HIGH);
  for (const Shape& shape : scene.shapes) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
    if (!mesh || mesh->triangles.empty()) continue;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh->positions.size()));
    std::copy(mesh->positions.begin(), mesh->positions.end(), vertices);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh->triangles.data(), 0, 12, mesh->triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(out, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(out);
  return out;
}

void report_ray_share(const Scene& scene) {
  const ThreadLimit one(1);
  const LightSampler lights(scene);
  std::vector<Tracer::LoggedRay> rays;
  const EyePaths logged{[&](Tracer& tracer, const Ray& ray, Gathered*) {
    tracer.log = &rays;
    return trace_path(tracer, lights, ray);
  }};
  trace_pixels(scene, {}, {1, 0}, logged);
  const EyePaths paths{
      [&](Tracer& tracer, const Ray& ray, Gathered*) { return trace_path(tracer, lights, ray); }};
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene bare = bare_scene(device, scene);
  std::vector<double> share;
  for (int i = 0; i < 7; ++i) {
    const double start = now();
    trace_pixels(scene, {}, {1, 0}, paths);
    const double whole = now() - start;
    share.push_back(cast_bare(bare, rays) / whole);
  }
  rtcReleaseScene(bare);
  rtcReleaseDevice(device);
  fmt::print(
      "path tracer, one thread       {:8.1f} %              of Embree's bare rate, {} rays\n",
      100 * median(share), rays.size());
}

void report_photons(const Scene& scene) {
  const LightSampler lights(scene);
  const std::int64_t count = 500'000;
  std::vector<double> emitted, stored, build;
  double bytes = 0;
  for (std::uint64_t i = 0; i < 5; ++i) {
    const double start = now();
    PhotonPass pass = trace_photons(scene, lights, PhotonKind::global, count, {1, i});
    const double traced = now();
    const PhotonMap map(std::move(pass.photons));
    emitted.push_back(static_cast<double>(count) / (traced - start));
    stored.push_back(static_cast<double>(map.size()) / (traced - start));
    build.push_back((now() - traced) * 1e6 / static_cast<double>(map.size()));
    bytes = static_cast<double>(map.memory()) / static_cast<double>(map.size());
  }
  fmt::print("photon pass, Cornell          {:8.2f} M paths/s     {:.2f} M photons stored/s\n",
             median(emitted) / 1e6, median(stored) / 1e6);
  fmt::print("photon map                    {:8.1f} bytes/photon  {:.3f} s per million to build\n",
             bytes, median(build));
}

/// Photon positions as nanoflann wants them.
struct Points {
  std::vector<Vec3> at;
  std::size_t kdtree_get_point_count() const { return at.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return at[i][static_cast<int>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3>;

/// The first `count` photons of a pass over `scene`.
std::vector<Photon> photons_of(const Scene& scene, std::uint64_t pass, std::size_t count) {
  std::vector<Photon> photons =
      trace_photons(scene, LightSampler(scene), PhotonKind::global, 400'000, {1, pass}).photons;
  photons.resize(std::min(count, photons.size()));
  return photons;
}

/// 50 nearest of 500 000 photons, ours with every test a photon must pass, nanoflann by position.
void report_look_ups(const Scene& scene) {
  const std::vector<Photon> photons = photons_of(scene, 0, 500'000);
  const std::vector<Photon> queries = photons_of(scene, 1, 20'000);
  Points points;
  for (const Photon& p : photons) points.at.push_back(p.position);
  const Tree tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const PhotonMap map(photons);
  std::vector<double> ours, theirs;
  NeighbourBuffer buffer;
  std::size_t found = 0;
  for (int run = 0; run < 5; ++run) {
    const double start = now();
    for (const Photon& q : queries) {
      found += map.nearest({.position = q.position, .normal = q.normal}, 50, buffer).size();
    }
    const double middle = now();
    for (const Photon& q : queries) {
      std::uint32_t index[50];
      float distance2[50];
      found += tree.knnSearch(&q.position.x, 50, index, distance2);
    }
    ours.push_back((middle - start) * 1e6 / static_cast<double>(queries.size()));
    theirs.push_back((now() - middle) * 1e6 / static_cast<double>(queries.size()));
  }
  fmt::print(
      "50 of {} photons, 1 thread {:6.2f} us/look-up      nanoflann {:.2f} us: {:.2f} x; {} "
      "found\n",
      photons.size(), median(ours), median(theirs), median(ours) / median(theirs), found);
}

void report_split(const char* name, const Scene& scene) {
  RenderConfig config;
  config.stop.passes = 8;
  const Progress p = run(scene, config).progress;
  const double all = p.timing.photons + p.timing.maps + p.timing.eye;
  fmt::print(
      "frame, {:<22} {:8.3f} s/pass        photons {:.0f} %, maps {:.0f} %, eye paths and "
      "look-ups {:.0f} %; {:.2f} M rays/s\n",
      name, p.seconds / p.passes, 100 * p.timing.photons / all, 100 * p.timing.maps / all,
      100 * p.timing.eye / all, p.rays_per_second / 1e6);
}

double rel_mse(const Image& image, const Image& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double x = image.pixels[i][c], y = reference.pixels[i][c];
      sum += (x - y) * (x - y) / (y * y + 0.01);
    }
  }
  return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

void report_equal_time(const char* name, const Scene& scene, double seconds) {
  // The reference is photon mapping's own only where the path tracer would need hours; here the
  // path tracer's, long enough that its noise is a small part of both errors.
  const Image truth = run(scene, path_for(0, 40 * seconds, 77)).film.radiance();
  RenderConfig photon;
  photon.stop.seconds = seconds;
  const double a = rel_mse(run(scene, photon).film.radiance(), truth);
  const double b = rel_mse(run(scene, path_for(0, seconds)).film.radiance(), truth);
  fmt::print(
      "equal time, {:<17} {:8.1f} s             relMSE photon {:.2e}, path {:.2e}: {:.2f} x\n",
      name, seconds, a, b, a / b);
}

int bench(int argc, char** argv) {
  const std::string scenes = std::string(OCTOLUX_SOURCE_DIR) + "/scenes/";
  const auto cornell = load_scene(argc > 1 ? argv[1] : scenes + "cornell/cornell.xml", {});
  const auto rooms = load_scene(argc > 2 ? argv[2] : scenes + "two-rooms/two-rooms.xml", {});
  set_size(*cornell, 256, 256);
  set_size(*rooms, 240, 160);
  fmt::print("{} threads\n", thread_count());
  report_path_rate(*cornell);
  report_ray_share(*cornell);
  report_photons(*cornell);
  report_look_ups(*cornell);
  report_split("Cornell 256x256", *cornell);
  report_split("two rooms 240x160", *rooms);
  report_equal_time("Cornell 256x256", *cornell, 4);
  report_equal_time("two rooms 240x160", *rooms, 4);
  return 0;
}

}  // namespace
}  // namespace octolux

int main(int argc, char** argv) {
  try {
    return octolux::bench(argc, argv);
  } catch (const octolux::Error& error) {
    fmt::print(stderr, "bench_render: {}\n", error.what());
    return 2;
  }
}
