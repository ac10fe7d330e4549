// <emitter>: light sources, in the units of the file (radiance W m^-2 sr^-1, intensity W sr^-1).
#include <utility>

#include "core/image_io.h"
#include "core/light.h"
#include "renderer/xml_daylight.h"
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

void add_environment(std::unique_ptr<EnvironmentLight> light, Scene& scene) {
  scene.environment.push_back(light.get());
  scene.lights.push_back(std::move(light));
}

}  // namespace

void set_environment(std::unique_ptr<EnvironmentLight> light, const Properties& p,
                     SceneBuilder& b) {
  Scene& scene = b.scene();
  if (!scene.environment.empty()) {
    fail(p.node().where,
         "there can be only one emitter that surrounds the scene (constant, envmap, sun, sky)");
  }
  add_environment(std::move(light), scene);
}

void set_environment(Image image, const Affine& to_world, float scale, const Properties& p,
                     SceneBuilder& b) {
  std::optional<Image> sun = take_out_sun(image);
  set_environment(make_envmap_light(std::move(image), to_world, scale), p, b);
  if (sun) add_environment(make_envmap_light(std::move(*sun), to_world, scale), b.scene());
}

namespace {

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
  set_environment(std::move(image), to_world, scale, p, b);
}

/// Towards which +z of to_world, or 'direction', shines.
void directional(Properties& p, SceneBuilder& b) {
  const std::optional<Vec3> given = p.point("direction");
  if (given && p.find("to_world")) p.fail("direction", "give either 'direction' or 'to_world'");
  const Vec3 direction = given ? *given : p.transform("to_world").vector({0, 0, 1});
  if (!(length(direction) > 0)) p.fail("direction", "'direction' must not be zero");
  const Rgb irradiance = read_emission(p, "irradiance");
  if (is_dark(p, irradiance, b)) return;
  b.scene().lights.push_back(make_directional_light(normalize(direction), irradiance));
}

void spot(Properties& p, SceneBuilder& b) {
  SpotConfig config{.to_world = p.transform("to_world"),
                    .intensity = read_emission(p, "intensity")};
  const float cutoff = p.positive("cutoff_angle", 20);
  const float beam = p.number("beam_width").value_or(0.75f * cutoff);
  if (!(cutoff < 90)) p.fail("cutoff_angle", "'cutoff_angle' must be below 90 degrees");
  if (!(beam >= 0 && beam <= cutoff)) {
    p.fail("beam_width", "'beam_width' must lie between 0 and 'cutoff_angle'");
  }
  config.cutoff = cutoff * kPi / 180;
  config.beam = beam * kPi / 180;
  if (const XmlNode* slide = p.find("texture")) config.texture = &b.texture(slide->object());
  if (is_dark(p, config.intensity, b)) return;
  b.scene().lights.push_back(make_spot_light(config));
}

void projector(Properties& p, SceneBuilder& b) {
  ProjectorConfig config{.to_world = p.transform("to_world")};
  const float scale = p.number("scale").value_or(1);
  if (scale < 0) p.fail("scale", "'scale' must not be negative");
  const XmlNode* given = p.find("irradiance");
  if (!given) p.fail("irradiance", "'irradiance' is missing: the picture that is thrown");
  if (given->object().tag == "texture") {
    const Texture& picture = b.texture(given->object());
    config.picture = Color(picture, Rgb(scale));
    config.aspect = picture.aspect();
  } else {
    config.picture = read_emission(p, "irradiance") * scale;
  }
  config.width = static_cast<float>(read_extent_x(p, config.aspect));
  if (is_dark(p, config.picture.mean(), b)) return;
  b.scene().lights.push_back(make_projector_light(config));
}

void lone_area(Properties& p, SceneBuilder&) {
  fail(p.node().where, "an area emitter needs a shape: nest it in one, or let one refer to it");
}

constexpr Plugin<void (*)(Properties&, SceneBuilder&)> kPlugins[] = {
    {"area", lone_area},
    {"point", point},
    {"constant", constant},
    {"envmap", environment_map},
    {"directional", directional},
    {"spot", spot},
    {"projector", projector},
    {"sun", add_sun},
    {"sky", add_sky},
    {"sunsky", add_sun_and_sky},
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
  const XmlNode* given = properties.find("radiance");
  const bool textured = given && given->object().tag == "texture";
  const Color radiance = textured ? Color(builder.texture(given->object()))
                                  : Color(read_emission(properties, "radiance"));
  builder.finish(properties);

  Scene& scene = builder.scene();
  Shape& shape = scene.shapes[shape_index];
  if (!(area(shape) > 0)) fail(emitter.where, "the shape of an area emitter has no area");
  if (is_dark(properties, radiance.mean(), builder)) return;
  shape.light = static_cast<int>(scene.lights.size());
  scene.lights.push_back(make_area_light(shape, radiance));
}

}  // namespace octolux
