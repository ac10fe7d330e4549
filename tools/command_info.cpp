// `octolux info`: what was loaded, so that a scene that renders black can be told from one that was
// read wrongly; and the displays and views pictures can be shown through.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "core/display.h"
#include "core/error.h"
#include "tools/commands.h"
#include "tools/scene_arguments.h"

namespace octolux {
namespace {

/// Lights listed one by one; of more, only the sum.
constexpr std::size_t kListedLights = 16;

struct GeometryCount {
  std::size_t triangles = 0;
  std::map<std::string, int> quadrics;
  std::size_t bytes = 0;  // vertices, indices, attributes
};

template <class T>
std::size_t bytes_of(const std::vector<T>& items) {
  return items.size() * sizeof(T);
}

GeometryCount count_geometry(const Scene& scene) {
  GeometryCount count;
  for (const Shape& shape : scene.shapes) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
      count.triangles += mesh->triangles.size();
      count.bytes += bytes_of(mesh->positions) + bytes_of(mesh->normals) + bytes_of(mesh->uvs) +
                     bytes_of(mesh->triangles);
      for (const MeshAttribute& a : mesh->attributes) count.bytes += bytes_of(a.values);
      continue;
    }
    const Quadric::Kind kind = std::get<Quadric>(shape.geometry).kind;
    ++count.quadrics[kind == Quadric::Kind::sphere ? "spheres"
                     : kind == Quadric::Kind::disk ? "disks"
                                                   : "cylinders"];
    count.bytes += sizeof(Quadric);
  }
  return count;
}

std::string join(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, n] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, name);
  }
  return text.empty() ? "none" : text;
}

/// What the renderer tells apart: which light paths a material takes part in.
std::string material_kind(const Bsdf& bsdf) {
  if (bsdf.passes_light()) return "see-through";
  const bool smooth = bsdf.has(Lobes::smooth), specular = bsdf.has(Lobes::specular);
  if (smooth && specular) return "diffuse or rough with specular";
  if (specular) return "specular";
  return smooth ? "diffuse or rough" : "black";
}

std::string light_kind(const Light& light) {
  if (dynamic_cast<const AreaLight*>(&light)) return "area";
  const bool environment = dynamic_cast<const EnvironmentLight*>(&light) != nullptr;
  if (environment) return light.narrow() ? "sun of the environment" : "environment";
  return "point or directional";
}

std::string shape_of(const Scene& scene, const Light& light) {
  for (std::size_t i = 0; i < scene.area_light_of_shape.size(); ++i) {
    if (scene.area_light_of_shape[i] == &light) return " '" + scene.shapes[i].name + "'";
  }
  return "";
}

std::string format(Vec3 v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }
std::string format(Rgb c) { return fmt::format("{:.6g} {:.6g} {:.6g} W", c.r, c.g, c.b); }

void print_geometry(const Scene& scene) {
  const GeometryCount count = count_geometry(scene);
  fmt::print("shapes     {}: {} triangles; round shapes: {}\n", scene.shapes.size(),
             count.triangles, join(count.quadrics));
  if (!scene.instances.empty()) {
    fmt::print("instances  {}, with {} shapes\n", scene.instances.size(),
               scene.caster->placed().size());
  }
  fmt::print("memory     {:.3g} MB of vertices and indices, {:.3g} MB to find hits in them\n",
             1e-6 * static_cast<double>(count.bytes),
             1e-6 * static_cast<double>(scene.caster->memory()));
  fmt::print("bounds     {} to {} m\n", format(scene.bounds.lower), format(scene.bounds.upper));
}

void print_materials(const Scene& scene) {
  std::map<std::string, int> kinds;
  for (const auto& bsdf : scene.bsdfs) ++kinds[material_kind(*bsdf)];
  fmt::print("materials  {}: {}\n", scene.bsdfs.size(), join(kinds));
  fmt::print("textures   {}\n", scene.textures.size());
}

void print_lights(const Scene& scene) {
  Rgb total(0);
  for (const auto& light : scene.lights) total += light->power();
  fmt::print("emitters   {}, power {} (red green blue)\n", scene.lights.size(), format(total));
  if (scene.lights.size() > kListedLights) return;
  for (const auto& light : scene.lights) {
    fmt::print("           {}{}: {}\n", light_kind(*light), shape_of(scene, *light),
               format(light->power()));
  }
}

const char* name_of(const Filter& filter) {
  switch (filter.kind) {
    case Filter::Kind::box:
      return "box";
    case Filter::Kind::tent:
      return "tent";
    case Filter::Kind::gaussian:
      return "gaussian";
    case Filter::Kind::mitchell:
      return "cubic";
    case Filter::Kind::lanczos:
      return "lanczos";
  }
  return "";
}

void print_camera(const Scene& scene) {
  const CameraConfig& camera = scene.camera_config;
  const FilmSize& film = scene.film;
  fmt::print("camera     at {} towards {}, {:.6g} degrees wide\n",
             format(camera.to_world.point({0, 0, 0})), format(scene.camera.forward()),
             camera.fov_x_degrees);
  fmt::print("film       {}x{}", film.width, film.height);
  if (film.crop_width != film.width || film.crop_height != film.height) {
    fmt::print(", crop {}x{} at {},{}", film.crop_width, film.crop_height, film.crop_x,
               film.crop_y);
  }
  fmt::print(", {} filter\n", name_of(scene.filter));
  fmt::print("max depth  {}{}\n", scene.max_depth < 0 ? "none" : fmt::format("{}", scene.max_depth),
             scene.hide_emitters ? "; emitters are hidden from the camera" : "");
}

void print_displays(const DisplayMenu& menu) {
  fmt::print("config     {}\n", menu.config.empty() ? "ours" : menu.config);
  for (const DisplayMenu::Display& display : menu.displays) {
    fmt::print("display    {}{}\n", display.name,
               display.name == menu.default_display ? " (default)" : "");
    for (const std::string& view : display.views) {
      fmt::print("  view     {}{}\n", view, view == display.default_view ? " (default)" : "");
    }
  }
}

class InfoCommand final : public Command {
 public:
  explicit InfoCommand(CLI::App& app)
      : verb_(app.add_subcommand("info", "Print what a scene file holds")) {
    scene_.add_to(*verb_);
    verb_->get_option("SCENE")->required(false);
    ocio_ = verb_->add_option("--ocio", config_,
                              "List the displays and views of this OpenColorIO configuration, "
                              "or of $OCIO's, or of ours");
    ocio_->type_name("[FILE]")->expected(0, 1);
  }
  bool chosen() const override { return verb_->parsed(); }

  int run() override {
    if (ocio_->count() > 0) {
      DisplayOptions options;
      options.ocio_config = config_;
      print_displays(display_menu(options));
      if (scene_.path.empty()) return 0;
    }
    if (scene_.path.empty()) throw Error("SCENE is required");
    ProgressPrinter printer(default_verbosity());
    const std::unique_ptr<Scene> scene = scene_.load(printer);
    fmt::print("scene      {} (hash {:016x})\n", scene_.path, scene->hash);
    print_geometry(*scene);
    print_materials(*scene);
    print_lights(*scene);
    print_camera(*scene);
    for (const std::string& warning : scene->warnings) fmt::print("warning    {}\n", warning);
    return 0;
  }

 private:
  CLI::App* verb_;
  SceneArguments scene_;
  std::string config_;
  CLI::Option* ocio_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_info_command(CLI::App& app) {
  return std::make_unique<InfoCommand>(app);
}

}  // namespace octolux
