// The top level of a scene file. Everything is made, used or not, so that every mistake is found;
// area lights come after the last shape, as they hold its address.
#include "renderer/xml_scene.h"

#include <vector>

#include "core/error.h"
#include "renderer/xml_objects.h"
#include "renderer/xml_shape_list.h"

namespace octolux {
namespace {

class TopLevel {
 public:
  TopLevel(const XmlDocument& document, Scene& scene, const LoadOptions& options)
      : builder_(document, scene), shapes_(builder_, options), scene_(scene) {
    for (const XmlNode& child : document.root().children) add(child);
    shapes_.finish(options.progress);
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
      shapes_.add(node);
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

  /// An <emitter> of the scene itself; an area emitter only if no shape took it.
  void add_emitter(const XmlNode& node) {
    if (shapes_.takes(node)) return;
    Properties properties(node);
    add_light(properties, builder_);
    builder_.finish(properties);
  }

  void add_sensor(const XmlNode& node) {
    if (sensor_) {
      builder_.warn(node.where, "only the first sensor is used");
      return;
    }
    sensor_ = &node;
    Properties properties(node);
    read_sensor(properties, builder_);
    builder_.finish(properties);
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
  ShapeList shapes_;
  Scene& scene_;
  const XmlNode* sensor_ = nullptr;
  const XmlNode* integrator_ = nullptr;
  std::vector<const XmlNode*> emitters_;
};

}  // namespace

void load_xml_scene(const std::string& path, const LoadOptions& options, Scene& scene) {
  const XmlDocument document(path, options.defines);
  TopLevel(document, scene, options);
}

}  // namespace octolux
