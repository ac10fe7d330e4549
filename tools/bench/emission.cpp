// How many photons reach a room from sun and sky, as one table:
//
//   build/bench_emission [SCENE.xml]     (default: the shipped daylight room)
//
// Photons per second that are stored where the eye may read them, in the cells of eye_cells.h and
// inside the room, for emission by power alone, around where photons are read (focus.h), through
// portals, and learned. The room is the box of daylight.xml; for another scene only the cells
// count. The time to learn is listed apart. Medians of several passes within this one process;
// compare ratios, machines are noisy.
#include <fmt/format.h>

#include "core/error.h"
#include "renderer/eye_cells.h"
#include "renderer/learn_emission.h"
#include "renderer/scene_loader.h"
#include "tools/bench/measuring.h"

namespace octolux {
namespace {

constexpr std::int64_t kPhotons = 200'000;  // per pass
constexpr std::uint64_t kPasses = 7;
constexpr Bounds kRoom{{-2.51f, -0.01f, -2.01f}, {2.51f, 2.81f, 2.01f}};

bool in_room(Vec3 p) { return max(kRoom.lower, p) == p && min(kRoom.upper, p) == p; }

/// Medians over passes, per second.
struct Rates {
  double paths = 0, stored = 0, seen = 0, room = 0;
};

Rates measure(const Scene& scene, const PhotonSource& source, const EyeCells& cells) {
  std::vector<double> paths, stored, seen, room;
  for (std::uint64_t pass = 0; pass < kPasses; ++pass) {
    const Stopwatch watch;
    const std::vector<Photon> photons =
        trace_photons(scene, source, PhotonKind::global, kPhotons, {1, pass}).photons;
    const double seconds = watch.seconds();
    double in_cells = 0, inside = 0;
    for (const Photon& p : photons) {
      in_cells += cells.find(p.position, p.normal) >= 0;
      inside += in_room(p.position);
    }
    paths.push_back(static_cast<double>(kPhotons) / seconds);
    stored.push_back(static_cast<double>(photons.size()) / seconds);
    seen.push_back(in_cells / seconds);
    room.push_back(inside / seconds);
  }
  return {median(paths), median(stored), median(seen), median(room)};
}

void print(const std::string& name, const Rates& r, const Rates& by_power) {
  fmt::print("{:<22} {:>8.3f} {:>8.3f} {:>9.4f} {:>9.4f} {:>6.1f} x\n", name, r.paths / 1e6,
             r.stored / 1e6, r.seen / 1e6, r.room / 1e6, r.room / by_power.room);
}

void report(const std::string& path, const std::string& with_portals) {
  const std::unique_ptr<Scene> scene = load_scene(path, {});
  const LightSampler lights(*scene);
  RenderConfig config;
  config =
      resolved(config, static_cast<std::int64_t>(scene->film.crop_width) * scene->film.crop_height);
  const EyeCells cells = look_around(*scene, PhotonKind::global, config.seed);
  const Stopwatch watch;
  const EmissionDensity learned = learn_emission(*scene, lights, config).global;
  const double seconds = watch.seconds();
  fmt::print("{}, millions per second\n", path);
  fmt::print("emission                  paths   stored where seen  in room\n");
  const EmissionDensity uniform;
  const std::unique_ptr<Scene> unfocused = load_scene(path, {});
  unfocused->set_focus(std::nullopt);
  const LightSampler everywhere(*unfocused);
  const Rates by_power = measure(*unfocused, {everywhere, uniform}, cells);
  print("by power", by_power, by_power);
  print("around the focus", measure(*scene, {lights, uniform}, cells), by_power);
  if (!with_portals.empty()) {
    const std::unique_ptr<Scene> marked = load_scene(with_portals, {});
    const LightSampler through(*marked);
    print("through portals", measure(*marked, {through, uniform}, cells), by_power);
  }
  print("learned", measure(*scene, {lights, learned}, cells), by_power);
  fmt::print("learned in {:.2f} s, both maps: {} boxes\n", seconds, learned.boxes());
}

int run(int argc, char** argv) {
  const std::string shipped = std::string(OCTOLUX_SOURCE_DIR) + "/scenes/daylight/";
  if (argc > 1) {
    report(argv[1], "");
  } else {
    report(shipped + "daylight.xml", shipped + "daylight-portals.xml");
  }
  return 0;
}

}  // namespace
}  // namespace octolux

int main(int argc, char** argv) {
  try {
    return octolux::run(argc, argv);
  } catch (const octolux::Error& error) {
    fmt::print(stderr, "bench_emission: {}\n", error.what());
    return 2;
  }
}
