// What each kernel costs against the cone, as one table:
//
//   build/bench_kernels
//
// Situations: look-ups on a plane of photons, and renders of a room, of two, and of a house, all
// on one thread. Two measures: processor time, of which the kernels take turns and the median ratio
// counts, because machines are noisy; and instructions, which repeat exactly. Instructions come
// from the processor's counter; where there is none (virtual machines), from valgrind's callgrind,
// under which the program then runs itself with `--count SITUATION KERNEL N` (20 minutes). Valgrind
// does not know AVX-512: on processors that have it, use the build of `cmake --preset avx2`.
#include <fmt/format.h>
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <optional>

#include "core/bsdf_makers.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/rng.h"
#include "renderer/render.h"
#include "renderer/scene_loader.h"
#include "tools/bench/measuring.h"

namespace octolux {
namespace {

using Work = std::function<void()>;

}  // namespace

/// All that is measured passes through here: callgrind counts while this function runs.
extern "C" __attribute__((noinline)) void octolux_measured(const Work& work) { work(); }

namespace {

constexpr int kRounds = 9;
const char* const kKernels[] = {"cone", "disc", "octobox", "feeler", "region"};

double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The processor's count of instructions in user mode, if it has one.
std::optional<double> count_by_processor(const Work& work) {
  perf_event_attr attributes{};
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.size = sizeof(attributes);
  attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
  attributes.exclude_kernel = attributes.exclude_hv = 1;
  const auto counter = static_cast<int>(syscall(SYS_perf_event_open, &attributes, 0, -1, -1, 0));
  if (counter < 0) return std::nullopt;
  std::uint64_t before = 0, after = 0;
  const bool started = read(counter, &before, sizeof(before)) == sizeof(before);
  octolux_measured(work);
  const bool stopped = read(counter, &after, sizeof(after)) == sizeof(after);
  close(counter);
  if (!started || !stopped) return std::nullopt;
  return static_cast<double>(after - before);
}

/// Queries in the inner part of a square plane of photons, one per square metre.
class PlaneLookUps {
 public:
  static constexpr int kSide = 700;      // [m]
  static constexpr int kQueries = 2000;  // per measurement

  PlaneLookUps() : shapes_(floor()), caster_(shapes_), white_(make_diffuse(Color(Rgb(0.5f)))) {
    Rng rng(1, Stream::test, 0, 0);
    std::vector<Photon> photons;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vec2 u = rng.uniform2();
      photons.push_back({{u.x * kSide, u.y * kSide, 0}, {0, 0, 1}, {0, 0, 1}, Rgb(1)});
    }
    map_ = PhotonMap(std::move(photons));
    for (int i = 0; i < kQueries; ++i) {
      const Vec2 u = rng.uniform2();
      const Ray ray{{kSide * (0.2f + 0.6f * u.x), kSide * (0.2f + 0.6f * u.y), 1}, {0, 0, -1}};
      points_.push_back(caster_.surface(caster_.closest(ray).value()));
    }
    for (const SurfacePoint& p : points_) {
      queries_.emplace_back(p, *white_, Vec3{0, 0, 1}, Carried::radiance);
    }
  }

  void operator()(const Estimator& estimator) const {
    float turn = 0;
    for (const Scattering& query : queries_) {
      turn += 1.0f / kQueries;
      sink_ = estimator.estimate({query, 255, &caster_, turn}, map_, {}).radiance.g;
    }
  }

 private:
  static std::vector<Shape> floor() {
    constexpr float kFar = kSide;
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {kFar, 0, 0}, {kFar, kFar, 0}, {0, kFar, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    Shape shape;
    shape.geometry = mesh;
    return {shape};
  }

  std::vector<Shape> shapes_;
  RayCaster caster_;
  std::unique_ptr<Bsdf> white_;
  PhotonMap map_;
  std::vector<SurfacePoint> points_;
  std::vector<Scattering> queries_;
  mutable volatile float sink_ = 0;  // so that nothing is optimised away
};

/// Two passes at default settings; the second one shrinks the bandwidth.
class RoomRender {
 public:
  RoomRender(const std::string& scene, const char* width, const char* height)
      : scene_(load_scene(std::string(OCTOLUX_SOURCE_DIR) + "/scenes/" + scene,
                          {{{"resx", width}, {"resy", height}}})) {}

  void operator()(const EstimatorConfig& estimator) const {
    RenderConfig config;
    config.estimator = estimator;
    config.stop.passes = 2;
    Silent observer;
    render(*scene_, config, observer);
  }

 private:
  std::unique_ptr<Scene> scene_;
};

struct Situation {
  std::string name;
  std::function<Work(const EstimatorConfig&)> work;
  double per_unit;  // look-ups or passes in one measurement
  std::vector<int> neighbours;
};

std::vector<Situation> make_situations() {
  const auto plane = std::make_shared<const PlaneLookUps>();
  const auto render_of = [](const std::string& name, const char* width, const char* height) {
    const auto room = std::make_shared<const RoomRender>(name + "/" + name + ".xml", width, height);
    return Situation{name,
                     [room](const EstimatorConfig& config) -> Work {
                       return [room, config] { (*room)(config); };
                     },
                     2,
                     {EstimatorConfig().neighbours}};
  };
  return {{"plane",
           [plane](const EstimatorConfig& config) -> Work {
             std::shared_ptr<const Estimator> estimator = make_estimator(config);
             return [plane, estimator] { (*plane)(*estimator); };
           },
           PlaneLookUps::kQueries,
           {20, 50, 200}},
          render_of("cornell", "128", "128"),
          render_of("two-rooms", "96", "64"),
          render_of("house", "96", "64")};
}

EstimatorConfig config_of(const std::string& kernel, int neighbours) {
  EstimatorConfig config;
  config.kernel = kernel;
  config.neighbours = neighbours;
  return config;
}

/// What callgrind counts in a run of this program with `--count`.
std::optional<double> count_by_valgrind(const Situation& situation, const EstimatorConfig& config) {
  const std::string command = fmt::format(
      "valgrind --tool=callgrind --toggle-collect=octolux_measured "
      "--callgrind-out-file=/dev/null /proc/{}/exe --count {} {} {} 2>&1",
      getpid(), situation.name, config.kernel, config.neighbours);
  FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) return std::nullopt;
  std::optional<double> count;
  char line[512];
  while (std::fgets(line, sizeof(line), output) != nullptr) {
    const char* found = std::strstr(line, "Collected : ");
    if (found != nullptr) count = std::atof(found + std::strlen("Collected : "));
  }
  return pclose(output) == 0 && count.value_or(0) > 0 ? count : std::nullopt;
}

/// Seconds of each kernel in each round; the kernels take turns.
std::vector<std::vector<double>> measure_times(const std::vector<Work>& works) {
  std::vector<std::vector<double>> seconds(works.size());
  for (const Work& work : works) octolux_measured(work);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < works.size(); ++i) {
      const double start = processor_seconds();
      octolux_measured(works[i]);
      seconds[i].push_back(processor_seconds() - start);
    }
  }
  return seconds;
}

void report(const Situation& situation, int neighbours) {
  std::vector<Work> works;
  for (const char* kernel : kKernels) {
    works.push_back(situation.work(config_of(kernel, neighbours)));
  }
  const auto seconds = measure_times(works);
  std::optional<double> cone_count;
  for (std::size_t i = 0; i < works.size(); ++i) {
    std::vector<double> ratios;
    for (int round = 0; round < kRounds; ++round) {
      ratios.push_back(seconds[i][round] / seconds[0][round]);
    }
    std::optional<double> count = count_by_processor(works[i]);
    if (!count) count = count_by_valgrind(situation, config_of(kKernels[i], neighbours));
    if (i == 0) cone_count = count;
    const double microseconds = 1e6 * median(seconds[i]) / situation.per_unit;
    const std::string instructions =
        count && cone_count
            ? fmt::format("{:12.0f} | {:5.3f}", *count / situation.per_unit, *count / *cone_count)
            : fmt::format("{:>12} | {:>5}", "-", "-");
    fmt::print("| {} | {:3} | {:7} | {:10.2f} | {:5.3f} | {} |\n", situation.name, neighbours,
               kKernels[i], microseconds, median(ratios), instructions);
    std::fflush(stdout);
  }
}

int bench(int argc, char** argv) {
  const ThreadLimit one(1);
  const std::vector<Situation> situations = make_situations();
  if (argc == 5 && std::string(argv[1]) == "--count") {
    for (const Situation& s : situations) {
      if (s.name == argv[2]) octolux_measured(s.work(config_of(argv[3], std::atoi(argv[4]))));
    }
    return 0;
  }
  fmt::print("| where | n | kernel | us per look-up or pass | x cone | instructions | x cone |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Situation& situation : situations) {
    for (const int neighbours : situation.neighbours) report(situation, neighbours);
  }
  return 0;
}

}  // namespace
}  // namespace octolux

int main(int argc, char** argv) {
  try {
    return octolux::bench(argc, argv);
  } catch (const octolux::Error& error) {
    fmt::print(stderr, "bench_kernels: {}\n", error.what());
    return 2;
  }
}
