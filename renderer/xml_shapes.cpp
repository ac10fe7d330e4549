// <shape>: meshes and quadrics in Mitsuba's conventions. A mirrored to_world (negative
// determinant) keeps the front side: outside stays outside, a rectangle still faces +z's image.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/frame.h"
#include "core/shape.h"
#include "renderer/xml_objects.h"

namespace octolux {
namespace {

using Geometry = std::variant<TriangleMesh, Quadric, MeshRequest>;

void turn_round(TriangleMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// Names of the mesh attributes that textures inside `node` read.
void add_attribute_names(const XmlNode& node, std::vector<std::string>& names) {
  if (node.tag == "texture") {
    const std::optional<std::string> name = mesh_attribute_name(node);
    if (name && std::find(names.begin(), names.end(), *name) == names.end()) {
      names.push_back(*name);
    }
  }
  for (const XmlNode& child : node.children) add_attribute_names(child.object(), names);
}

bool read_flip(Properties& p) { return p.boolean("flip_normals").value_or(false); }

/// What all mesh files have in common.
MeshRequest mesh_file(Properties& p, SceneBuilder& b, MeshRequest::Format format) {
  MeshRequest request;
  request.format = format;
  request.path = b.find_file(p, "filename");
  MeshOptions& o = request.options;
  o.to_world = p.transform("to_world");
  o.face_normals = p.boolean("face_normals").value_or(false);
  o.flip_normals = read_flip(p);
  o.max_smooth_angle = p.number("max_smooth_angle");
  if (o.max_smooth_angle && !(*o.max_smooth_angle >= 0 && *o.max_smooth_angle <= 180)) {
    p.fail("max_smooth_angle", "'max_smooth_angle' must lie between 0 and 180 degrees");
  }
  if (o.max_smooth_angle && o.face_normals) {
    p.fail("max_smooth_angle", "give either 'face_normals' or 'max_smooth_angle'");
  }
  add_attribute_names(p.node(), request.attributes);
  return request;
}

Geometry obj(Properties& p, SceneBuilder& b) {
  MeshRequest request = mesh_file(p, b, MeshRequest::Format::obj);
  request.options.flip_tex_coords = p.boolean("flip_tex_coords").value_or(true);
  return request;
}

Geometry ply(Properties& p, SceneBuilder& b) {
  MeshRequest request = mesh_file(p, b, MeshRequest::Format::ply);
  request.options.flip_tex_coords = p.boolean("flip_tex_coords").value_or(false);
  return request;
}

Geometry serialized(Properties& p, SceneBuilder& b) {
  MeshRequest request = mesh_file(p, b, MeshRequest::Format::serialized);
  request.shape_index = p.integer("shape_index").value_or(0);
  if (request.shape_index < 0) p.fail("shape_index", "'shape_index' must not be negative");
  return request;
}

/// Appends the parallelogram spanned by u and v at `origin`, uv from (0, 0) to (1, 1), facing v x u
/// if `mirror_uv`, otherwise u x v.
void add_quad(TriangleMesh& mesh, Vec3 origin, Vec3 u, Vec3 v, bool mirror_uv) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3 p : {origin, origin + u, origin + u + v, origin + v}) mesh.positions.push_back(p);
  for (const Vec2 uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) mesh.uvs.push_back(uv);
  const std::uint32_t a = mirror_uv ? 3 : 1, c = mirror_uv ? 1 : 3;
  mesh.triangles.push_back({first, first + a, first + 2});
  mesh.triangles.push_back({first, first + 2, first + c});
}

TriangleMesh placed(TriangleMesh mesh, Properties& p) {
  const Affine to_world = p.transform("to_world");
  for (Vec3& position : mesh.positions) position = to_world.point(position);
  if ((to_world.determinant() < 0) != read_flip(p)) turn_round(mesh);
  return mesh;
}

Geometry rectangle(Properties& p, SceneBuilder&) {
  TriangleMesh mesh;
  add_quad(mesh, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, false);
  return placed(std::move(mesh), p);
}

Geometry cube(Properties& p, SceneBuilder&) {
  struct Face {
    Vec3 origin, u, v;  // where texture coordinates start and run to; v x u points outwards
  };
  constexpr Face kFaces[] = {
      {{-1, -1, -1}, {0, 0, 2}, {2, 0, 0}},  // -y
      {{1, 1, 1}, {-2, 0, 0}, {0, 0, -2}},   // +y
      {{1, -1, 1}, {0, 2, 0}, {0, 0, -2}},   // +x
      {{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}},   // +z
      {{-1, -1, -1}, {0, 2, 0}, {0, 0, 2}},  // -x
      {{-1, 1, -1}, {0, -2, 0}, {2, 0, 0}},  // -z
  };
  TriangleMesh mesh;
  for (const Face& f : kFaces) add_quad(mesh, f.origin, f.u, f.v, true);
  return placed(std::move(mesh), p);
}

Quadric make_quadric(Quadric::Kind kind, const Affine& to_world, Properties& p) {
  const std::optional<Affine> inverse = to_world.inverse();
  if (!inverse) fail(p.node().where, "the " + p.type() + " is flat: its transform is singular");
  return {.kind = kind, .to_world = to_world, .to_object = *inverse, .flip = read_flip(p)};
}

Geometry sphere(Properties& p, SceneBuilder&) {
  const Vec3 c = p.point("center").value_or(Vec3{0, 0, 0});
  const float r = p.positive("radius", 1);
  const Affine to_world = p.transform("to_world");
  return make_quadric(Quadric::Kind::sphere,
                      to_world * translation(c.x, c.y, c.z) * scaling(r, r, r), p);
}

Geometry disk(Properties& p, SceneBuilder&) {
  return make_quadric(Quadric::Kind::disk, p.transform("to_world"), p);
}

Geometry cylinder(Properties& p, SceneBuilder&) {
  const Vec3 p0 = p.point("p0").value_or(Vec3{0, 0, 0});
  const Vec3 p1 = p.point("p1").value_or(Vec3{0, 0, 1});
  const float r = p.positive("radius", 1);
  const Vec3 axis = p1 - p0;
  if (!(length(axis) > 0)) p.fail("p1", "'p0' and 'p1' must differ");
  const Frame f = Frame::from_normal(normalize(axis));
  const Vec3 x = f.s * r, y = f.t * r;
  const Affine along{
      {{{x.x, y.x, axis.x, p0.x}, {x.y, y.y, axis.y, p0.y}, {x.z, y.z, axis.z, p0.z}}}};
  return make_quadric(Quadric::Kind::cylinder, p.transform("to_world") * along, p);
}

Geometry group_in_place(Properties& p, SceneBuilder&) {
  fail(p.node().where, "a shape '" + p.type() + "' cannot stand here");
}

constexpr Plugin<Geometry (*)(Properties&, SceneBuilder&)> kPlugins[] = {
    {"obj", obj},
    {"ply", ply},
    {"serialized", serialized},
    {"rectangle", rectangle},
    {"cube", cube},
    {"sphere", sphere},
    {"disk", disk},
    {"cylinder", cylinder},
    // Not single shapes: see xml_shape_list.cpp.
    {"shapegroup", group_in_place},
    {"instance", group_in_place},
};

std::string describe(const XmlNode& node) {
  const std::string* id = node.attribute("id");
  const std::string file = node.where.file + ":" + std::to_string(node.where.line);
  return id ? *id : node.required("type") + " (" + file + ")";
}

}  // namespace

MadeShape make_shape(Properties& properties, SceneBuilder& builder) {
  const std::vector<const XmlNode*> bsdfs = properties.objects("bsdf");
  const XmlNode& node = properties.node();
  if (bsdfs.size() > 1) fail(node.where, "a shape takes only one bsdf");
  MadeShape made;
  made.shape.name = describe(node);
  Geometry geometry = find_plugin(kPlugins, properties)(properties, builder);
  if (auto* request = std::get_if<MeshRequest>(&geometry)) {
    made.file = std::move(*request);
  } else if (auto* quadric = std::get_if<Quadric>(&geometry)) {
    made.shape.geometry = *quadric;
  } else {
    made.shape.geometry = std::move(std::get<TriangleMesh>(geometry));
  }
  std::vector<std::string> attributes;
  add_attribute_names(node, attributes);
  if (!made.file && !attributes.empty()) {
    fail(node.where, "a shape '" + properties.type() + "' has no mesh attribute '" +
                         attributes.front() + "'; PLY files may have them");
  }
  made.shape.bsdf = bsdfs.empty() ? builder.default_bsdf() : builder.bsdf(*bsdfs.front());
  return made;
}

}  // namespace octolux
