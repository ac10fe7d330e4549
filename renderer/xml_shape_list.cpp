// xml_shape_list.h.
#include "renderer/xml_shape_list.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "core/instance.h"

namespace octolux {
namespace {

constexpr std::size_t kMostPlacements = std::size_t{1} << 24;
/// Up to here Embree's float inverse keeps the digits that place() counts on.
constexpr double kMostSkew = 8;

}  // namespace

void ShapeList::add(const XmlNode& node, Group& to) {
  const std::string& type = node.required("type");
  if (type == "shapegroup") {
    if (&to != &world_) fail(node.where, "a shapegroup cannot stand inside another; instance it");
    group(node);
    return;
  }
  if (type == "instance") return add_instance(node, to);

  Properties properties(node);
  const std::vector<const XmlNode*> emitters = properties.objects("emitter");
  if (emitters.size() > 1) fail(node.where, "a shape takes only one emitter");
  if (options_.skip_missing && !builder_.has_file(properties, "filename")) {
    return builder_.warn(node.where, "the shape is left out: its file is missing");
  }
  MadeShape made = make_shape(properties, builder_);
  builder_.finish(properties);
  if (made.file) {
    requests_.push_back(std::move(*made.file));
    entry_of_request_.push_back(entries_.size());
  }
  to.entries.push_back(entries_.size());
  const XmlNode* portal = is_portal(node, !emitters.empty()) ? &node : nullptr;
  entries_.push_back(
      {std::move(made.shape), emitters.empty() ? nullptr : emitters.front(), portal});
  if (const std::string* id = node.attribute("id")) ids_.push_back(*id);
}

int ShapeList::group(const XmlNode& node) {
  const auto known = group_of_node_.find(&node);
  if (known != group_of_node_.end()) return known->second;
  Properties properties(node);
  Group made;
  for (const XmlNode* shape : properties.objects("shape")) add(*shape, made);
  builder_.finish(properties);
  if (made.entries.empty() && made.inside.empty()) fail(node.where, "the shapegroup is empty");
  groups_.push_back(std::move(made));
  return group_of_node_[&node] = static_cast<int>(groups_.size()) - 1;
}

void ShapeList::add_instance(const XmlNode& node, Group& to) {
  Properties properties(node);
  const std::vector<const XmlNode*> shapes = properties.objects("shape");
  if (shapes.size() != 1 || shapes.front()->required("type") != "shapegroup") {
    fail(node.where, "an instance needs one shapegroup: nest it, or refer to it by <ref>");
  }
  Placement placement{0, properties.transform("to_world")};
  builder_.finish(properties);
  placement.group = group(*shapes.front());
  groups_[static_cast<std::size_t>(placement.group)].used = true;
  to.inside.push_back(placement);
}

void ShapeList::load_files(const LoadProgress& progress) {
  LoadedMeshes loaded = load_meshes(requests_, progress);
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    LoadedMesh& mesh = loaded.meshes[i];
    for (const std::string& warning : mesh.warnings) builder_.warn(warning);
    entries_[entry_of_request_[i]].shape.geometry = std::move(mesh.mesh);
  }
  Scene& scene = builder_.scene();
  if (!requests_.empty()) scene.hash = hash64(scene.hash ^ loaded.hash);
}

/// By option, or because its id or name says so; a light is not one by name.
bool ShapeList::is_portal(const XmlNode& node, bool emits) const {
  const std::string* id = node.attribute("id");
  const std::vector<std::string>& chosen = options_.portals;
  if (id && std::find(chosen.begin(), chosen.end(), *id) != chosen.end()) {
    if (emits) fail(node.where, "the portal '" + *id + "' has an emitter; a portal is no surface");
    return true;
  }
  const auto says_so = [](const std::string* name) {
    std::string text = name ? *name : "";
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text.find("portal") != std::string::npos;
  };
  return !emits && (says_so(id) || says_so(node.attribute("name")));
}

void ShapeList::check_portals() const {
  for (const std::string& id : options_.portals) {
    if (std::find(ids_.begin(), ids_.end(), id) != ids_.end()) continue;
    throw Error("--portal " + id + ": " + unknown_name("shape", id, ids_));
  }
}

void ShapeList::put(Shape shape, const Entry& entry) {
  if (entry.portal) return put_portal(std::move(shape), *entry.portal);
  std::vector<Shape>& shapes = builder_.scene().shapes;
  if (entry.emitter) area_lights_.emplace_back(entry.emitter, shapes.size());
  shapes.push_back(std::move(shape));
}

void ShapeList::put_portal(Shape shape, const XmlNode& node) {
  auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
  if (!mesh) {
    fail(node.where, "the portal '" + shape.name + "' must consist of triangles, not be a '" +
                         node.required("type") + "'");
  }
  if (!(area(shape) > 0)) fail(node.where, "the portal '" + shape.name + "' has no area");
  Scene& scene = builder_.scene();
  scene.notes.push_back("'" + shape.name +
                        "' is a portal, not a surface: photons of sun, sky and environment are "
                        "aimed at it");
  scene.portals.push_back(std::move(*mesh));
}

void ShapeList::expand(const Group& from, const Affine& to_world) {
  for (const Placement& p : from.inside) {
    if (placements_.size() == kMostPlacements) throw Error("more than 2^24 instances");
    const Affine there = to_world * p.to_world;
    placements_.push_back({p.group, there});
    expand(groups_[static_cast<std::size_t>(p.group)], there);
  }
}

void ShapeList::place_groups() {
  Scene& scene = builder_.scene();
  std::vector<std::size_t> uses(groups_.size());
  for (const Placement& p : placements_) ++uses[static_cast<std::size_t>(p.group)];
  std::vector<int> number(groups_.size(), -1);  // in the scene
  int numbers = 0;
  for (const Placement& p : placements_) {
    const auto g = static_cast<std::size_t>(p.group);
    const bool copy = uses[g] == 1 || skew(p.to_world) > kMostSkew;
    std::vector<const Shape*> shared;
    for (const std::size_t e : groups_[g].entries) {
      Entry& entry = entries_[e];
      if (copy || entry.emitter || entry.portal) {
        Shape shape = uses[g] == 1 ? std::move(entry.shape) : entry.shape;
        put(moved(std::move(shape), p.to_world), entry);
      } else {
        shared.push_back(&entry.shape);
      }
    }
    if (shared.empty()) continue;
    if (number[g] < 0) {
      number[g] = numbers++;
      for (const Shape* shape : shared) {
        scene.shapes.push_back(*shape);
        scene.shapes.back().group = number[g];
      }
    }
    scene.instances.push_back({number[g], p.to_world, *p.to_world.inverse()});
  }
}

void ShapeList::finish(const LoadProgress& progress) {
  check_portals();
  load_files(progress);
  for (const std::size_t e : world_.entries) put(std::move(entries_[e].shape), entries_[e]);
  expand(world_, {});
  place_groups();
  for (const auto& [node, g] : group_of_node_) {
    if (!groups_[static_cast<std::size_t>(g)].used) {
      builder_.warn(node->where, "no instance uses this shapegroup; it is not in the picture");
    }
  }
  // Last, because lights hold on to their shapes.
  for (const auto& [emitter, shape] : area_lights_) add_area_light(*emitter, shape, builder_);
}

bool ShapeList::takes(const XmlNode& emitter) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& e) { return e.emitter == &emitter; });
}

}  // namespace octolux
