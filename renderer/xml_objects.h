// Makers of the objects of a Mitsuba scene, one kind per source file. Each file opens with the
// table of plug-ins it knows; adding one is a function and a line.
//
// All read the parameters they know from `properties`; the caller checks that none is left over.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "renderer/mesh_loader.h"
#include "renderer/properties.h"
#include "renderer/scene_builder.h"

namespace octolux {

std::unique_ptr<Bsdf> make_bsdf(Properties& properties, SceneBuilder& builder);
std::unique_ptr<Texture> make_texture(Properties& properties, SceneBuilder& builder);
/// The name of the attribute if this <texture> reads a mesh attribute.
std::optional<std::string> mesh_attribute_name(const XmlNode& texture);

/// A shape whose mesh may still have to be read from a file.
struct MadeShape {
  Shape shape;
  std::optional<MeshRequest> file;
};
/// Geometry and BSDF; the light is added by add_area_light.
MadeShape make_shape(Properties& properties, SceneBuilder& builder);
/// Camera, film and filter of the scene.
void read_sensor(Properties& properties, SceneBuilder& builder);
/// Extent along x, at distance 1, of a picture of that aspect (width / height) as `fov`, `fov_axis`
/// and `focal_length` give it.
double read_extent_x(Properties& properties, double aspect);
/// Scene::max_depth and hide_emitters.
void read_integrator(Properties& properties, SceneBuilder& builder);

/// Adds an emitter that is no shape (not `area`) to the scene.
void add_light(Properties& properties, SceneBuilder& builder);
/// Makes `light` the scene's environment, of which there can be only one.
void set_environment(std::unique_ptr<EnvironmentLight> light, const Properties& properties,
                     SceneBuilder& builder);
/// The same for an environment map (make_envmap_light); a sun in it becomes a light of its own.
void set_environment(Image image, const Affine& to_world, float scale, const Properties& properties,
                     SceneBuilder& builder);
/// Makes Scene::shapes[shape] emit. The list of shapes must be final.
void add_area_light(const XmlNode& emitter, std::size_t shape, SceneBuilder& builder);

/// A line of a plug-in table.
template <typename Function>
struct Plugin {
  const char* name;
  Function make;
};

/// The line for this object's type; Error with the legal names if there is none.
template <typename Function, std::size_t size>
Function find_plugin(const Plugin<Function> (&table)[size], const Properties& properties) {
  std::vector<std::string> names;
  for (const Plugin<Function>& plugin : table) {
    if (properties.type() == plugin.name) return plugin.make;
    names.push_back(plugin.name);
  }
  const XmlNode& node = properties.node();
  fail(node.where, unknown_name(node.tag + " plug-in", properties.type(), names));
}

}  // namespace octolux
