// The scenes whose renders are held against references, and which kernels are held where: those
// whose stated bias (bias.h) covers what the scene has. make_references.cpp renders the references
// from the same table, so that both always are of the same scene.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/renderer/renders.h"

namespace octolux::test {

struct RegressionCase {
  const char* name;  // of the reference: tests/regression/references/NAME.exr
  const char* scene;
  std::map<std::string, std::string> defines;
  struct {
    int width, height;
  } film;
  std::int64_t photons;               // paths per pass and map, gathered
  std::int64_t shown_photons;         // and shown: few, so that look-ups are wider than pixels
  std::vector<std::string> shown;     // kernels held with the photon map shown directly
  std::vector<std::string> gathered;  // kernels held with a final gather
  double reference_error = 0.01;      // mean relative standard error of the reference's pixels
};

/// Thin walls leak, and stairs are many strips side by side, for all kernels that do not look at
/// the geometry: nothing is stated for them there. `feeler` does not see free edges, and behind
/// shafts narrower than the gap of two rays `region` leaks too, as scenes/feelers says. The glass
/// sphere's lamp is large, because a path tracer hardly finds the caustic of a small one; its map
/// is not shown, since the caustic's shape is narrower than a look-up.
inline const std::vector<RegressionCase>& regression_cases() {
  static const std::vector<RegressionCase> cases = {
      {"cornell",
       "cornell/cornell.xml",
       {},
       {48, 48},
       40'000,
       4'000,
       {"disc", "cone", "octobox", "hull", "feeler", "region"},
       {"cone", "octobox", "feeler", "region"}},
      {"glass-sphere",
       "glass-sphere/glass-sphere.xml",
       {{"lamp", "1.2"}},
       {48, 36},
       50'000,
       0,
       {},
       {"octobox", "region"}},
      {"wall-and-corner",
       "wall-and-corner/wall-and-corner.xml",
       {},
       {48, 36},
       40'000,
       4'000,
       {"cone", "octobox", "feeler", "region"},
       {"octobox"}},
      {"thin-wall",
       "thin-wall/thin-wall.xml",
       {},
       {48, 28},
       40'000,
       8'000,
       {"feeler", "region"},
       {"feeler"}},
      {"stairs", "stairs/stairs.xml", {}, {48, 36}, 80'000, 20'000, {"region"}, {"region"}},
      {"corridors",
       "corridors/corridors.xml",
       {},
       {48, 36},
       80'000,
       20'000,
       {"octobox", "region"},
       {"octobox"}},
      {"feelers", "feelers/feelers.xml", {}, {48, 36}, 80'000, 0, {}, {}},
      {"house", "house/house.xml", {}, {48, 28}, 80'000, 0, {}, {"region"}, 0.02},
  };
  return cases;
}

inline const RegressionCase& regression_case(const std::string& name) {
  for (const RegressionCase& c : regression_cases()) {
    if (name == c.name) return c;
  }
  throw Error("no regression case " + name);
}

/// The case's film in a scene: a box filter, so that a pixel is its own square and no other's.
inline void set_film(Scene& scene, const RegressionCase& c) {
  resize_film(scene, c.film.width, c.film.height);
  scene.filter = {Filter::Kind::box, 0.5f, 0.5f};
}

inline std::unique_ptr<Scene> load_case(const RegressionCase& c) {
  auto scene = shipped_scene(c.scene, c.defines);
  set_film(*scene, c);
  return scene;
}

inline std::string reference_path(const RegressionCase& c) {
  return std::string(OCTOLUX_SOURCE_DIR "/tests/regression/references/") + c.name + ".exr";
}

}  // namespace octolux::test
