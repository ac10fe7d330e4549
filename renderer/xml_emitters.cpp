// <emitter>: light sources, in the units of the file (radiance W m^-2 sr^-1, intensity W sr^-1).
#include <utility>

#include "core/image_io.h"
#include "core/light.h"
#include "renderer/xml_objects.h"

namespace octolux {
namespace {

Rgb read_emission(Properties& p, const std::string& name) {
  return p.color(name, ColorRole::emission).value_or(Rgb(1));
}

/// A light of no power would only take samples away from the others.
bool is_dark(const Properties& p, Rgb emission, SceneBuilder& b) {
  if (!is_black(emission)) return false;
  b.warn(p.node().where, "the emitter '" + p.type() + "' is black; ignored");
  return true;
}

void set_environment(std::unique_ptr<EnvironmentLight> light, const Properties& p,
                     SceneBuilder& b) {
  Scene& scene = b.scene();
  if (scene.environment) fail(p.node().where, "there can be only one constant or envmap emitter");
  scene.environment = light.get();
  scene.lights.push_back(std::move(light));
}

void point(Properties& p, SceneBuilder& b) {
  const Affine to_world = p.transform("to_world");
  const std::optional<Vec3> position = p.point("position");
  if (position && p.find("to_world")) p.fail("position", "give either 'position' or 'to_world'");
  const Rgb intensity = read_emission(p, "intensity");
  if (is_dark(p, intensity, b)) return;
  b.scene().lights.push_back(
      make_point_light(position.value_or(to_world.point({0, 0, 0})), intensity));
}

void constant(Properties& p, SceneBuilder& b) {
  const Rgb radiance = read_emission(p, "radiance");
  if (is_dark(p, radiance, b)) return;
  set_environment(make_constant_light(radiance), p, b);
}

void environment_map(Properties& p, SceneBuilder& b) {
  const Affine to_world = p.transform("to_world");
  const float scale = p.number("scale").value_or(1);
  if (scale < 0) p.fail("scale", "'scale' must not be negative");
  p.ignore({"mis_compensation", "cache"});
  Image image = read_image(b.file(p, "filename"), Encoding::automatic);
  if (is_dark(p, Rgb(scale), b)) return;
  set_environment(make_envmap_light(std::move(image), to_world, scale), p, b);
}

void lone_area(Properties& p, SceneBuilder&) {
  fail(p.node().where, "an area emitter needs a shape: nest it in one, or let one refer to it");
}

constexpr Plugin<void (*)(Properties&, SceneBuilder&)> kPlugins[] = {
    {"area", lone_area},
    {"point", point},
    {"constant", constant},
    {"envmap", environment_map},
};

}  // namespace

void add_light(Properties& properties, SceneBuilder& builder) {
  properties.ignore({"sampling_weight"});
  find_plugin(kPlugins, properties)(properties, builder);
}

void add_area_light(const XmlNode& emitter, std::size_t shape_index, SceneBuilder& builder) {
  Properties properties(emitter);
  if (find_plugin(kPlugins, properties) != lone_area) {
    fail(emitter.where, "an emitter '" + properties.type() + "' cannot stand inside a shape");
  }
  properties.ignore({"sampling_weight"});
  const Rgb radiance = read_emission(properties, "radiance");
  builder.finish(properties);

  Scene& scene = builder.scene();
  Shape& shape = scene.shapes[shape_index];
  if (!(area(shape) > 0)) fail(emitter.where, "the shape of an area emitter has no area");
  if (is_dark(properties, radiance, builder)) return;
  shape.light = static_cast<int>(scene.lights.size());
  scene.lights.push_back(make_area_light(shape, radiance));
}

}  // namespace octolux
