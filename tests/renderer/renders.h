// What render tests share: scenes from text, quiet renders, statistics over pixels.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "renderer/render.h"
#include "renderer/scene_loader.h"
#include "tests/stats.h"

namespace octolux::test {

/// Loads a Mitsuba XML scene given as text.
inline std::unique_ptr<Scene> scene_from(const std::string& xml) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("octolux_test_" + std::to_string(getpid()) + ".xml");
  std::ofstream(path) << xml;
  std::unique_ptr<Scene> scene = load_scene(path.string(), {});
  std::filesystem::remove(path);
  return scene;
}

/// A scene of this repository, with -D values.
inline std::unique_ptr<Scene> shipped_scene(
    const std::string& name, const std::map<std::string, std::string>& defines = {}) {
  return load_scene(std::string(OCTOLUX_SOURCE_DIR) + "/scenes/" + name, {defines});
}

/// Gives the film another size.
inline void resize_film(Scene& scene, int width, int height) {
  scene.film = {width, height, 0, 0, width, height};
  scene.camera = Camera(scene.camera_config, scene.film);
}

/// A perspective sensor as XML; box filter, so that a pixel sees its own square only.
inline std::string sensor_xml(const std::string& origin, const std::string& target, double fov,
                              int width, int height) {
  return "<sensor type='perspective'><float name='fov' value='" + std::to_string(fov) +
         "'/><float name='near_clip' value='0.0001'/><transform name='to_world'><lookat origin='" +
         origin + "' target='" + target +
         "' up='0, 1, 0'/></transform><film type='hdrfilm'><integer name='width' value='" +
         std::to_string(width) + "'/><integer name='height' value='" + std::to_string(height) +
         "'/><rfilter type='box'/></film></sensor>";
}

/// The walls of a closed room as XML: 4 m wide, its floor at y = 0.
inline std::string closed_room_xml(double reflectance) {
  return "<shape type='cube'><transform name='to_world'><scale value='-2'/><translate y='2'/>"
         "</transform><bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='" +
         std::to_string(reflectance) + "'/></bsdf></bsdf></shape>";
}

/// Watches passes with a function, or just lets them go by.
class Watch : public RenderObserver {
 public:
  explicit Watch(std::function<void(const Progress&, const Film&)> see = {})
      : see_(std::move(see)) {}
  bool pass_done(const Progress& progress, const Film& film) override {
    if (see_) see_(progress, film);
    return true;
  }

 private:
  std::function<void(const Progress&, const Film&)> see_;
};

inline RenderConfig path_config(int passes, std::uint64_t seed = 1) {
  RenderConfig config;
  config.integrator = Integrator::path;
  config.seed = seed;
  config.stop.passes = passes;
  return config;
}

/// One eye sample a pass, so that passes and photons are what a test counts.
inline RenderConfig photon_config(int passes, std::int64_t photons, std::uint64_t seed = 1) {
  RenderConfig config;
  config.seed = seed;
  config.photons.global = photons;
  config.photons.caustic = photons;
  config.eye.samples_per_pass = 1;
  config.stop.passes = passes;
  return config;
}

inline Film render_film(const Scene& scene, const RenderConfig& config) {
  Watch watch;
  return std::move(render(scene, config, watch).film);
}

/// Pictures by the seeds 1, 2, ... `count`.
inline std::vector<Film> render_seeds(const Scene& scene, RenderConfig config, int count) {
  std::vector<Film> films;
  for (int i = 1; i <= count; ++i) {
    config.seed = static_cast<std::uint64_t>(i);
    films.push_back(render_film(scene, config));
  }
  return films;
}

/// The green of each pixel over several pictures.
inline std::vector<Running> each_pixel(const std::vector<Film>& films) {
  std::vector<Running> pixels;
  for (const Film& film : films) {
    const Image radiance = film.radiance();
    pixels.resize(radiance.pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].add(radiance.pixels[i].g);
  }
  return pixels;
}

/// Mean over all pixels and channels, with its standard error from the passes' variance (pixels are
/// independent of each other in a path-traced picture only).
struct MeanRadiance {
  double mean = 0, standard_error = 0;
};
inline MeanRadiance mean_radiance(const Film& film) {
  const Image radiance = film.radiance(), variance = film.variance();
  MeanRadiance out;
  double var = 0;
  for (std::size_t i = 0; i < radiance.pixels.size(); ++i) {
    out.mean += mean(radiance.pixels[i]);
    var += mean(variance.pixels[i]);  // upper bound on the variance of the channels' mean
  }
  const auto n = static_cast<double>(radiance.pixels.size());
  out.mean /= n;
  out.standard_error = std::sqrt(var) / n;
  return out;
}

/// A picture, and the mean radiance of each pass by itself: its spread knows what pixels of a pass
/// have in common.
struct Rendered {
  Film film;
  Running pass_means;
};
inline Rendered rendered(const Scene& scene, const RenderConfig& config) {
  Running passes;
  double before = 0;
  Watch watch([&](const Progress& progress, const Film& film) {
    const double sum = mean_radiance(film).mean * progress.passes;
    passes.add(sum - before);
    before = sum;
  });
  Film film = render(scene, config, watch).film;
  return {std::move(film), passes};
}
inline Running pass_means(const Scene& scene, const RenderConfig& config) {
  return rendered(scene, config).pass_means;
}

/// "two-rooms/two-rooms.xml" as a test's name: tworooms.
inline std::string scene_name(std::string path) {
  path = path.substr(0, path.find('/'));
  path.erase(std::remove(path.begin(), path.end(), '-'), path.end());
  return path;
}

/// mean (x - y)^2 / (y^2 + 0.01) over pixels and channels (DESIGN section 6).
inline double rel_mse(const Image& image, const Image& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double x = image.pixels[i][c], y = reference.pixels[i][c];
      sum += (x - y) * (x - y) / (y * y + 0.01);
    }
  }
  return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

/// Per pixel and channel z-test of two films with their own variances. `failed` counts those beyond
/// Sidak's limit for `alpha`; z holds all deviates.
struct PixelTest {
  int failed = 0;
  std::vector<double> z;
  double chi2_over_dof() const {
    double sum = 0;
    for (const double v : z) sum += v * v;
    return sum / static_cast<double>(z.size());
  }
};
inline PixelTest pixel_z_test(const Film& a, const Film& b, double alpha) {
  const Image ma = a.radiance(), mb = b.radiance(), va = a.variance(), vb = b.variance();
  PixelTest out;
  for (std::size_t i = 0; i < ma.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double variance = static_cast<double>(va.pixels[i][c]) + vb.pixels[i][c];
      if (variance > 0) out.z.push_back((ma.pixels[i][c] - mb.pixels[i][c]) / std::sqrt(variance));
    }
  }
  const double limit = sidak(alpha, static_cast<double>(out.z.size()));
  for (const double z : out.z) out.failed += z_test_p(z) < limit;
  return out;
}

}  // namespace octolux::test
