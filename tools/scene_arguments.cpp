// scene_arguments.h with CLI11.
#include "tools/scene_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "renderer/scene_loader.h"
#include "tools/loading_monitor.h"
#include "tools/settings.h"

namespace octolux {
namespace {

/// The largest film side, and the most pixels.
constexpr int kMaxSide = 1 << 16;
constexpr double kMaxPixels = 1 << 28;

struct FilmExtent {
  int width = 0, height = 0;
};

FilmExtent parse_size(const std::string& text) {
  const std::string source = "--size " + text;
  const auto x = text.find('x');
  if (x == std::string::npos) throw Error(source + ": expected WIDTHxHEIGHT, such as 640x480");
  const FilmExtent size{parse_int(source, text.substr(0, x), 1, kMaxSide),
                        parse_int(source, text.substr(x + 1), 1, kMaxSide)};
  if (static_cast<double>(size.width) * size.height > kMaxPixels) {
    throw Error(source + ": expected at most 2^28 pixels");
  }
  return size;
}

/// Gives the film another size; a crop window keeps its share of it.
void resize(Scene& scene, FilmExtent size) {
  FilmSize& film = scene.film;
  const double sx = static_cast<double>(size.width) / film.width;
  const double sy = static_cast<double>(size.height) / film.height;
  const auto scaled = [](int value, double scale) {
    return static_cast<int>(std::lround(value * scale));
  };
  const int right = scaled(film.crop_x + film.crop_width, sx);
  const int bottom = scaled(film.crop_y + film.crop_height, sy);
  film.crop_x = std::min(scaled(film.crop_x, sx), size.width - 1);
  film.crop_y = std::min(scaled(film.crop_y, sy), size.height - 1);
  film.crop_width = std::max(1, right - film.crop_x);
  film.crop_height = std::max(1, bottom - film.crop_y);
  film.width = size.width;
  film.height = size.height;
  scene.camera = Camera(scene.camera_config, film);
}

}  // namespace

void SceneArguments::add_to(CLI::App& verb) {
  verb.add_option("SCENE", path, "Mitsuba XML (.xml), or Wavefront OBJ (.obj) with its MTL")
      ->required()
      ->type_name("");
  verb.add_option("-D", defines, "Set the scene file's parameter $name; repeatable")
      ->type_name("name=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.add_option("--portal", portals,
                  "The shape of this id is an opening through which sun and sky come in, and no "
                  "surface; repeatable")
      ->type_name("ID")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.add_flag("--skip-missing", skip_missing,
                "Leave out shapes whose file is missing, with a warning");
}

void SceneArguments::add_size_to(CLI::App& verb) {
  verb.add_option("--size", size, "Film size in pixels, instead of the scene's")->type_name("WxH");
}

void SceneArguments::check() const {
  if (!size.empty()) parse_size(size);
}

std::unique_ptr<Scene> SceneArguments::load(ProgressPrinter& printer) const {
  check();
  LoadOptions options;
  for (const std::string& define : defines) {
    const auto equals = define.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw Error("-D " + define + ": expected name=value");
    }
    options.defines[define.substr(0, equals)] = define.substr(equals + 1);
  }
  options.portals = portals;
  options.skip_missing = skip_missing;
  LoadingMonitor monitor(printer);
  options.progress = monitor.progress();
  std::unique_ptr<Scene> scene = load_scene(path, options);
  if (!size.empty()) resize(*scene, parse_size(size));
  return scene;
}

}  // namespace octolux
