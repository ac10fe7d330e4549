// The <shape>s of a scene file, groups and instances among them: first listed, then all their mesh
// files read at once, then put into the scene.
//
// A group that stands in the scene once is simply put there. One that stands there several times
// becomes instances; of its emitters, though, each place gets a copy, because a light has a place
// of its own, and so does a place whose map shears (core/instance.h, skew). Shapes that are portals
// (core/light_portal.h) by name or by option go into a list of their own. Not thread-safe.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "renderer/load_options.h"
#include "renderer/xml_objects.h"

namespace octolux {

class ShapeList {
 public:
  /// `options` must outlive the list.
  ShapeList(SceneBuilder& builder, const LoadOptions& options)
      : builder_(builder), options_(options) {}

  /// A <shape> at the top level.
  void add(const XmlNode& node) { add(node, world_); }
  /// Reads the files and fills the scene's shapes, instances and area lights. Once, after the last
  /// add.
  void finish(const LoadProgress& progress);
  /// Has some shape taken this <emitter>?
  bool takes(const XmlNode& emitter) const;

 private:
  struct Entry {
    Shape shape;
    const XmlNode* emitter = nullptr;
    const XmlNode* portal = nullptr;  // the shape's node if it is a portal
  };
  struct Placement {
    int group = 0;
    Affine to_world;
  };
  /// Entries (by number) and other groups; the world is one.
  struct Group {
    std::vector<std::size_t> entries;
    std::vector<Placement> inside;
    bool used = false;
  };

  void add(const XmlNode& node, Group& to);
  void add_instance(const XmlNode& node, Group& to);
  int group(const XmlNode& node);
  void load_files(const LoadProgress& progress);
  void expand(const Group& from, const Affine& to_world);
  void place_groups();
  bool is_portal(const XmlNode& node, bool emits) const;
  void check_portals() const;
  void put(Shape shape, const Entry& entry);
  void put_portal(Shape shape, const XmlNode& node);

  SceneBuilder& builder_;
  const LoadOptions& options_;
  std::vector<std::string> ids_;  // of all shapes
  std::vector<Entry> entries_;
  std::vector<MeshRequest> requests_;
  std::vector<std::size_t> entry_of_request_;
  Group world_;
  std::vector<Group> groups_;
  std::map<const XmlNode*, int> group_of_node_;
  std::vector<Placement> placements_;  // of all groups, nested ones too, in the world
  std::vector<std::pair<const XmlNode*, std::size_t>> area_lights_;  // and their shapes
};

}  // namespace octolux
