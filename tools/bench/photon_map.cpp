// Building the photon map and looking photons up, beside nanoflann on the same photons and queries:
// uniform on the six faces of a box, and clustered as caustics are. One query is one iteration.
//
// nanoflann knows positions only, so ours is measured twice: with filters that every photon passes
// (all normals and directions agree) and with the ones a room has.
#include "accel/photon_map.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

enum class Scene { box, clusters };

/// Uniform on the faces of a box of 4 x 3 x 5 m, or in Gaussian spots on them.
struct Sampler {
  Scene scene;
  bool all_pass;
  Rng rng;

  Photon operator()() {
    static constexpr Vec3 kSize{4, 3, 5};
    const std::uint32_t face = rng.next() % 6;
    const Vec2 at = in_face();
    const float side = static_cast<float>(face % 2);
    Photon p;
    p.normal = {0, 0, 0};
    const float inward = 1 - 2 * side;
    if (face / 2 == 0) p.position = {side, at.x, at.y}, p.normal.x = inward;
    if (face / 2 == 1) p.position = {at.x, side, at.y}, p.normal.y = inward;
    if (face / 2 == 2) p.position = {at.x, at.y, side}, p.normal.z = inward;
    p.position = {p.position.x * kSize.x, p.position.y * kSize.y, p.position.z * kSize.z};
    p.wi = normalize(p.normal + sample_sphere(rng.uniform2()) * 0.999f);  // cosine-distributed
    if (all_pass) p.normal = p.wi = {0, 0, 1};
    p.flux = Rgb(1);
    return p;
  }

  Vec2 in_face() {
    const Vec2 u = rng.uniform2();
    if (scene == Scene::box) return u;
    const std::uint32_t cluster = rng.next() % 20;
    const float radius =
        0.002f * static_cast<float>(1 + cluster) * std::sqrt(-2 * std::log(1 - u.x));
    const float cx = static_cast<float>(hash64(cluster) % 1000) * 0.001f;
    const float cy = static_cast<float>(hash64(cluster + 100) % 1000) * 0.001f;
    const float phi = 2 * kPi * u.y;
    return {std::clamp(cx + radius * std::cos(phi), 0.0f, 1.0f),
            std::clamp(cy + radius * std::sin(phi), 0.0f, 1.0f)};
  }
};

constexpr int kPhotons = 500000;
constexpr int kQueries = 20000;

std::vector<Photon> make_photons(Scene scene, bool all_pass, int count) {
  Sampler sampler{scene, all_pass, Rng(1, Stream::test, 0, 0)};
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) photons.push_back(sampler());
  return photons;
}

std::vector<PhotonQuery> make_queries(Scene scene, bool all_pass) {
  Sampler sampler{scene, all_pass, Rng(1, Stream::test, 1, 0)};
  std::vector<PhotonQuery> queries;
  for (int i = 0; i < kQueries; ++i) {
    const Photon at = sampler();
    PhotonQuery query;
    query.position = at.position;
    query.normal = at.normal;
    if (all_pass) query.squash = 1;  // the metric nanoflann has
    queries.push_back(query);
  }
  return queries;
}

/// What nanoflann needs to see.
struct Cloud {
  std::vector<Photon> photons;
  std::size_t kdtree_get_point_count() const { return photons.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return photons[i].position[static_cast<int>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Flann =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3>;

Scene scene_of(const benchmark::State& state) { return static_cast<Scene>(state.range(0)); }

/// Radius that holds 50 photons on average on the box.
float radius_of_50() {
  const float area = 2 * (4 * 3 + 4 * 5 + 3 * 5);
  return std::sqrt(50 * area / (kPi * kPhotons));
}

void build_ours(benchmark::State& state) {
  const auto photons = make_photons(scene_of(state), false, static_cast<int>(state.range(1)));
  double bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<Photon> given = photons;
    state.ResumeTiming();
    const PhotonMap map(std::move(given));
    bytes = static_cast<double>(map.memory()) / static_cast<double>(map.size());
  }
  state.counters["bytes_per_photon"] = bytes;
}

void build_nanoflann(benchmark::State& state) {
  const Cloud cloud{make_photons(scene_of(state), false, static_cast<int>(state.range(1)))};
  for (auto _ : state) {
    const Flann tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    benchmark::DoNotOptimize(&tree);
  }
}

template <bool all_pass, bool radius>
void query_ours(benchmark::State& state) {
  const PhotonMap map(make_photons(scene_of(state), all_pass, kPhotons));
  std::vector<PhotonQuery> queries = make_queries(scene_of(state), all_pass);
  for (PhotonQuery& query : queries) query.max_radius = radius ? radius_of_50() : 1e30f;
  const auto k = static_cast<std::size_t>(state.range(1));
  NeighbourBuffer buffer;
  std::size_t i = 0, found = 0;
  for (auto _ : state) {
    const PhotonQuery& query = queries[i++ % kQueries];
    found += (radius ? map.within(query, buffer) : map.nearest(query, k, buffer)).size();
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}

void nearest_nanoflann(benchmark::State& state) {
  const Cloud cloud{make_photons(scene_of(state), false, kPhotons)};
  const Flann tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const auto queries = make_queries(scene_of(state), false);
  const auto k = static_cast<std::size_t>(state.range(1));
  std::vector<std::uint32_t> indices(k);
  std::vector<float> distances(k);
  std::size_t i = 0, found = 0;
  for (auto _ : state) {
    const Vec3 x = queries[i++ % kQueries].position;
    const float point[3] = {x.x, x.y, x.z};
    found += tree.knnSearch(point, k, indices.data(), distances.data());
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}

void within_nanoflann(benchmark::State& state) {
  const Cloud cloud{make_photons(scene_of(state), false, kPhotons)};
  const Flann tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const auto queries = make_queries(scene_of(state), false);
  const float radius2 = radius_of_50() * radius_of_50();
  std::vector<std::pair<std::uint32_t, float>> matches;
  const nanoflann::SearchParams unsorted(0, 0, false);
  std::size_t i = 0, found = 0;
  for (auto _ : state) {
    const Vec3 x = queries[i++ % kQueries].position;
    const float point[3] = {x.x, x.y, x.z};
    found += tree.radiusSearch(point, radius2, matches, unsorted);
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}

constexpr int kBox = static_cast<int>(Scene::box);
constexpr int kClusters = static_cast<int>(Scene::clusters);

BENCHMARK(build_ours)
    ->Args({kBox, 1000000})
    ->Args({kClusters, 1000000})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(build_nanoflann)
    ->Args({kBox, 1000000})
    ->Args({kClusters, 1000000})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(query_ours<true, false>)
    ->Name("nearest_ours_all_pass")
    ->Args({kBox, 50})
    ->Args({kClusters, 50})
    ->Args({kBox, 500});
BENCHMARK(query_ours<false, false>)
    ->Name("nearest_ours_filtered")
    ->Args({kBox, 50})
    ->Args({kClusters, 50})
    ->Args({kBox, 500});
BENCHMARK(nearest_nanoflann)->Args({kBox, 50})->Args({kClusters, 50})->Args({kBox, 500});
BENCHMARK(query_ours<true, true>)
    ->Name("within_ours_all_pass")
    ->Args({kBox, 0})
    ->Args({kClusters, 0});
BENCHMARK(query_ours<false, true>)
    ->Name("within_ours_filtered")
    ->Args({kBox, 0})
    ->Args({kClusters, 0});
BENCHMARK(within_nanoflann)->Args({kBox, 0})->Args({kClusters, 0});

}  // namespace
}  // namespace octolux

BENCHMARK_MAIN();
