// The top level of a scene file. Everything is made, used or not, so that every mistake is found;
// area lights come last, as they hold the address of their shape.
#include "renderer/xml_scene.h"

#include <set>
#include <utility>

#include "core/error.h"
#include "renderer/xml_objects.h"

namespace octolux {
namespace {

class TopLevel {
 public:
  TopLevel(const XmlDocument& document, Scene& scene) : builder_(document, scene), scene_(scene) {
    for (const XmlNode& child : document.root().children) add(child);
    for (const auto& [emitter, shape] : area_lights_) add_area_light(*emitter, shape, builder_);
    for (const XmlNode* emitter : emitters_) add_emitter(*emitter);
    check(document.root());
  }

 private:
  void add(const XmlNode& node) {
    if (node.tag == "bsdf") {
      builder_.bsdf(node);
    } else if (node.tag == "texture") {
      builder_.texture(node);
    } else if (node.tag == "shape") {
      add_shape(node);
    } else if (node.tag == "emitter") {
      emitters_.push_back(&node);
    } else if (node.tag == "sensor") {
      add_sensor(node);
    } else if (node.tag == "integrator") {
      add_integrator(node);
    } else if (!may_stand_alone(node.tag)) {
      fail(node.where, "<" + node.tag + "> cannot stand at the top level of a scene");
    }
  }

  /// Without effect until something refers to them.
  static bool may_stand_alone(const std::string& tag) {
    return tag == "alias" || tag == "film" || tag == "rfilter" || tag == "sampler";
  }

  void add_shape(const XmlNode& node) {
    Properties properties(node);
    const std::vector<const XmlNode*> emitters = properties.objects("emitter");
    if (emitters.size() > 1) fail(node.where, "a shape takes only one emitter");
    scene_.shapes.push_back(make_shape(properties, builder_));
    properties.finish();
    for (const XmlNode* emitter : emitters) {
      area_lights_.emplace_back(emitter, scene_.shapes.size() - 1);
    }
  }

  /// An <emitter> of the scene itself; an area emitter only if no shape took it.
  void add_emitter(const XmlNode& node) {
    for (const auto& [emitter, shape] : area_lights_) {
      if (emitter == &node) return;
    }
    Properties properties(node);
    add_light(properties, builder_);
    properties.finish();
  }

  void add_sensor(const XmlNode& node) {
    if (sensor_) {
      builder_.warn(node.where, "only the first sensor is used");
      return;
    }
    sensor_ = &node;
    Properties properties(node);
    read_sensor(properties, builder_);
    properties.finish();
  }

  void add_integrator(const XmlNode& node) {
    if (integrator_) fail(node.where, "a scene takes only one integrator");
    integrator_ = &node;
    Properties properties(node);
    read_integrator(properties, builder_);
  }

  void check(const XmlNode& root) {
    if (!sensor_) fail(root.where, "the scene has no sensor; add <sensor type=\"perspective\">");
    if (scene_.shapes.empty()) fail(root.where, "the scene has no shapes");
    if (scene_.lights.empty()) builder_.warn(root.where, "nothing in the scene emits light");
  }

  SceneBuilder builder_;
  Scene& scene_;
  const XmlNode* sensor_ = nullptr;
  const XmlNode* integrator_ = nullptr;
  std::vector<const XmlNode*> emitters_;
  std::vector<std::pair<const XmlNode*, std::size_t>> area_lights_;  // and their shapes
};

}  // namespace

void load_xml_scene(const std::string& path, const std::map<std::string, std::string>& defines,
                    Scene& scene) {
  const XmlDocument document(path, defines);
  TopLevel(document, scene);
}

}  // namespace octolux
