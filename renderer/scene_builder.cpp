// Bookkeeping of shared objects, and the parameters that several kinds of objects have in common.
#include "renderer/scene_builder.h"

#include <algorithm>

#include "core/bsdf_makers.h"
#include "core/file_io.h"
#include "core/hash.h"
#include "renderer/xml_extras.h"
#include "renderer/xml_objects.h"

namespace octolux {

SceneBuilder::SceneBuilder(const XmlDocument& document, Scene& scene)
    : document_(document), scene_(scene) {
  scene_.hash = document.hash();
  for (const std::string& text : document.warnings()) warn(text);
}

int SceneBuilder::bsdf(const XmlNode& object) {
  const auto known = bsdfs_.find(&object);
  if (known != bsdfs_.end()) return known->second;
  Properties properties(object);
  std::unique_ptr<Bsdf> made = make_bsdf(properties, *this);
  finish(properties);
  scene_.bsdfs.push_back(std::move(made));
  return bsdfs_[&object] = static_cast<int>(scene_.bsdfs.size()) - 1;
}

int SceneBuilder::default_bsdf() {
  if (default_bsdf_ < 0) {
    scene_.bsdfs.push_back(make_diffuse(Rgb(0.5f)));
    default_bsdf_ = static_cast<int>(scene_.bsdfs.size()) - 1;
  }
  return default_bsdf_;
}

const Texture& SceneBuilder::texture(const XmlNode& object) {
  const auto known = textures_.find(&object);
  if (known != textures_.end()) return *known->second;
  Properties properties(object);
  std::unique_ptr<Texture> made = make_texture(properties, *this);
  finish(properties);
  scene_.textures.push_back(std::move(made));
  textures_[&object] = scene_.textures.back().get();
  return *scene_.textures.back();
}

Color SceneBuilder::color(Properties& properties, const std::string& name, float fallback) {
  const XmlNode* node = properties.find(name);
  if (node && node->object().tag == "texture") return Color(texture(node->object()));
  return constant_color(properties, name, fallback);
}

Rgb SceneBuilder::constant_color(Properties& properties, const std::string& name, float fallback) {
  const Rgb c = properties.color(name, ColorRole::reflectance).value_or(Rgb(fallback));
  if (max_component(c) <= 1) return c;
  warn(properties.where(name), "'" + name + "' is above 1; clamped");
  return {std::min(c.r, 1.0f), std::min(c.g, 1.0f), std::min(c.b, 1.0f)};
}

std::string SceneBuilder::find_file(Properties& properties, const std::string& name) {
  const std::optional<std::string> given = properties.text(name);
  if (!given) properties.fail(name, "the parameter '" + name + "' is missing");
  const FoundFile found = document_.find_file(*given, properties.where(name));
  if (found.differs) {
    warn(properties.where(name), "there is no '" + *given + "'; '" + found.path + "' is used");
  }
  return found.path;
}

bool SceneBuilder::has_file(Properties& properties, const std::string& name) const {
  const std::optional<std::string> given = properties.text(name);
  return !given || document_.has_file(*given, properties.where(name));
}

std::string SceneBuilder::file(Properties& properties, const std::string& name) {
  std::string path = find_file(properties, name);
  if (hashed_files_.insert(path).second) {
    scene_.hash = hash_bytes(scene_.hash, read_file(path));
  }
  return path;
}

void SceneBuilder::finish(Properties& properties) {
  ignore_extras(properties, *this);
  properties.finish();
}

void SceneBuilder::warn(const std::string& text) {
  std::vector<std::string>& all = scene_.warnings;
  if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
}

void SceneBuilder::warn(const Location& where, const std::string& text) {
  warn(where.file + ":" + std::to_string(where.line) + ": " + text);
}

void SceneBuilder::warn_once(const std::string& kind, const Location& where,
                             const std::string& text) {
  if (warned_.insert(kind).second) warn(where, text);
}

}  // namespace octolux
