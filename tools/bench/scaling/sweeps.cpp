// sweeps.h. A pass is one of photon mapping at default settings; the first one of a render, before
// which it learns, does not count.
#include "tools/bench/scaling/sweeps.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/parallel.h"
#include "renderer/photon_memory.h"
#include "renderer/photon_pass.h"
#include "renderer/scene_loader.h"
#include "tools/bench/measuring.h"
#include "tools/bench/scaling/scenes.h"

namespace octolux {
namespace {

constexpr int kSide = 256;               // pixels of the film, where they do not vary
constexpr std::int64_t kTrial = 200000;  // paths that tell how many photons a path stores
/// Memory [bytes] per triangle while a mesh is loaded, measured: the file, corners and mesh, then
/// mesh and Embree's tree while it is built.
constexpr double kBytesPerTriangle = 160;
/// What allocators add to the photons' own bytes, and [bytes] the batch of paths at work.
constexpr double kOverhead = 1.05, kBatchMemory = 3e8;

/// Powers of ten and their halves, rounded: 1, 3, 10, 32, 100 ...
std::vector<double> half_decades(int low, int high) {
  std::vector<double> sizes;
  for (int i = 2 * low; i <= 2 * high; ++i) sizes.push_back(std::round(std::pow(10, i / 2.0)));
  return sizes;
}

/// Notes the seconds of every pass but the first.
class PassTimer : public RenderObserver {
 public:
  bool pass_done(const Progress& progress, const Film&) override {
    if (progress.passes > 1) {
      seconds_.push_back(progress.pass_seconds);
      total_ += progress.pass_seconds;
    }
    return !enough(seconds_.size(), total_);
  }
  double median_seconds() const { return median(seconds_); }

 private:
  std::vector<double> seconds_;
  double total_ = 0;
};

double seconds_a_pass(const Scene& scene) {
  RenderConfig config;
  config.eye.samples_per_pass = 1;  // on every film
  config.stop.passes = 1 << 20;     // the timer stops it
  PassTimer timer;
  render(scene, config, timer);
  return timer.median_seconds();
}

std::unique_ptr<Scene> load_sized(const std::string& path, int side) {
  std::unique_ptr<Scene> scene = load_scene(path, {});
  set_size(*scene, side, side);
  return scene;
}

/// Memory [bytes] while a map of so many photons is built, when it is most.
double photon_memory(double photons) { return kBatchMemory + kOverhead * kBytesToMap * photons; }

/// Seconds to trace about so many photons, and to build their map; its bytes a photon.
ScalingStep measure_photons(const Scene& scene, double size) {
  const LightSampler lights(scene);
  const auto trace = [&](double paths) {
    return trace_photons(scene, lights, PhotonKind::global, static_cast<std::int64_t>(paths), {})
        .photons;
  };
  const double per_path = static_cast<double>(trace(kTrial).size()) / kTrial;
  double stored = 0;
  const std::vector<double> medians = median_of_runs([&]() -> std::vector<double> {
    const Stopwatch tracing;
    std::vector<Photon> photons = trace(std::round(size / per_path));
    const double traced = tracing.seconds();
    const Stopwatch building;
    const PhotonMap map(std::move(photons));
    const double built = building.seconds();
    stored = static_cast<double>(map.size());
    return {traced, built, static_cast<double>(map.memory()) / stored};
  });
  return {stored, medians};
}

double count_triangles(const Scene& scene) {
  double count = 0;
  for (const Shape& shape : scene.shapes) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
    if (mesh) count += static_cast<double>(mesh->triangles.size());
  }
  return count;
}

/// Seconds to load a scene whose files have just been written, and a pass of it.
std::pair<std::unique_ptr<Scene>, std::vector<double>> measure_room(const GeneratedRoom& room) {
  std::unique_ptr<Scene> scene;
  std::vector<double> medians = median_of_runs([&]() -> std::vector<double> {
    scene.reset();
    const Stopwatch watch;
    scene = load_scene(room.path(), {});
    return {watch.seconds()};
  });
  set_size(*scene, kSide, kSide);
  medians.push_back(seconds_a_pass(*scene));
  return {std::move(scene), medians};
}

ScalingStep measure_triangles(double size) {
  const auto [scene, medians] = measure_room(WavyRoom(std::llround(size)));
  return {count_triangles(*scene), medians};
}

ScalingStep measure_lights(double size) {
  const auto [scene, medians] = measure_room(LampRoom(std::llround(size)));
  return {static_cast<double>(scene->lights.size()), medians};
}

ScalingStep measure_threads(const std::string& cornell, double size) {
  const ThreadLimit limit(static_cast<int>(size));
  return {size, {seconds_a_pass(*load_sized(cornell, kSide))}};
}

ScalingStep measure_pixels(const std::string& cornell, double size) {
  const int side = static_cast<int>(std::lround(std::sqrt(size)));
  return {size, {seconds_a_pass(*load_sized(cornell, side))}};
}

/// 1, 2, 4 ... and all; on one processor two threads, too.
std::vector<double> thread_counts() {
  const int all = std::max(2, thread_count());
  std::vector<double> counts;
  for (int n = 1; n < all; n *= 2) counts.push_back(n);
  counts.push_back(all);
  return counts;
}

std::vector<double> film_sizes() {
  std::vector<double> sizes;
  for (const double side : {64, 96, 128, 192, 256, 384, 512, 768, 1024}) {
    sizes.push_back(side * side);
  }
  return sizes;
}

}  // namespace

std::vector<Sweep> all_sweeps(const std::string& cornell) {
  const Quantity load{"load", "s"}, pass{"pass", "s"};
  return {
      {"photons",
       "Photons: Cornell",
       "photons",
       {{"trace", "s"}, {"build map", "s"}, {"memory", "bytes/photon"}},
       half_decades(4, 8),
       1,
       [cornell](double size) { return measure_photons(*load_scene(cornell, {}), size); },
       photon_memory},
      {"triangles",
       "Triangles: room with a wavy floor, 256x256",
       "triangles",
       {load, pass},
       half_decades(3, 7),
       1,
       measure_triangles,
       [](double triangles) { return kBytesPerTriangle * triangles; }},
      {"lights",
       "Lights: room with area lights on the ceiling, 256x256",
       "lights",
       {load, pass},
       half_decades(0, 5),
       1,
       measure_lights},
      {"threads",
       "Threads: Cornell 256x256",
       "threads",
       {pass},
       thread_counts(),
       -1,
       [cornell](double size) { return measure_threads(cornell, size); }},
      {"pixels",
       "Pixels: Cornell",
       "pixels",
       {pass},
       film_sizes(),
       1,
       [cornell](double size) { return measure_pixels(cornell, size); }},
  };
}

}  // namespace octolux
