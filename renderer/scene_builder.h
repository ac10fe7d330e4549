// The state of a scene while it is built from a document: objects made so far, files found, the
// warnings. Used by the makers of each kind of object (xml_objects.h). Not thread-safe.
#pragma once

#include <map>
#include <set>
#include <string>

#include "renderer/properties.h"
#include "renderer/scene.h"
#include "renderer/xml_document.h"

namespace octolux {

class SceneBuilder {
 public:
  SceneBuilder(const XmlDocument& document, Scene& scene);

  Scene& scene() { return scene_; }

  /// Index of this <bsdf> in Scene::bsdfs; made once.
  int bsdf(const XmlNode& object);
  /// Mitsuba's default: diffuse, reflectance 1/2.
  int default_bsdf();
  /// This <texture>; made once.
  const Texture& texture(const XmlNode& object);

  /// A reflectance or opacity: colour or texture. Above 1 it is clamped, with a warning.
  Color color(Properties& properties, const std::string& name, float fallback);
  /// The same where a texture is not modelled.
  Rgb constant_color(Properties& properties, const std::string& name, float fallback);

  /// Path of the file that the string parameter `name` (required) gives.
  std::string find_file(Properties& properties, const std::string& name);
  /// False if the parameter is there, and the file is not.
  bool has_file(Properties& properties, const std::string& name) const;
  /// As find_file; its content becomes part of the hash.
  std::string file(Properties& properties, const std::string& name);

  /// As properties.finish(), after what exporters add is ignored with a warning (xml_extras.h).
  void finish(Properties& properties);

  void warn(const std::string& text);
  void warn(const Location& where, const std::string& text);
  /// Nothing if there was a warning of this `kind` already.
  void warn_once(const std::string& kind, const Location& where, const std::string& text);

 private:
  const XmlDocument& document_;
  Scene& scene_;
  std::map<const XmlNode*, int> bsdfs_;
  std::map<const XmlNode*, const Texture*> textures_;
  std::set<std::string> hashed_files_, warned_;
  int default_bsdf_ = -1;
};

}  // namespace octolux
