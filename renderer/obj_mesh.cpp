// Sharing vertices, and normals; see obj_mesh.h.
#include "renderer/obj_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "renderer/mesh_normals.h"

namespace octolux {
namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

}  // namespace

ObjMeshBuilder::ObjMeshBuilder(const ObjFile& file, const ObjMeshOptions& options)
    : file_(file), options_(options), first_vertex_(file.positions.size(), -1) {
  const auto inverse = options.to_world.inverse();
  if (!inverse) throw Error(file.path + ": to_world is singular");
  mirrored_ = options.to_world.determinant() < 0;
  positions_.reserve(file.positions.size());
  for (const Vec3 p : file.positions) positions_.push_back(options.to_world.point(p));
  if (!std::all_of(positions_.begin(), positions_.end(), [](Vec3 p) { return is_finite(p); })) {
    throw Error(file.path + ": to_world moves a vertex out of the range of float");
  }
  normals_.reserve(file.normals.size());
  for (const Vec3 n : file.normals) {
    normals_.push_back(direction(Affine::normal(*inverse, direction(n))));
  }
}

bool ObjMeshBuilder::has_normals(const ObjTriangle& triangle) const {
  return std::all_of(triangle.corners.begin(), triangle.corners.end(), [&](const ObjCorner& c) {
    return c.normal >= 0 && length2(normals_[at(c.normal)]) > 0;
  });
}

bool ObjMeshBuilder::wants_normals(std::span<const std::uint32_t> triangles) const {
  return !options_.ignore_normals &&
         std::any_of(triangles.begin(), triangles.end(),
                     [&](std::uint32_t t) { return has_normals(file_.triangles[t]); });
}

bool ObjMeshBuilder::wants_tex_coords(std::span<const std::uint32_t> triangles) const {
  return std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
    const auto& corners = file_.triangles[t].corners;
    return corners[0].tex_coord >= 0 || corners[1].tex_coord >= 0 || corners[2].tex_coord >= 0;
  });
}

void ObjMeshBuilder::add_vertex(const ObjCorner& corner, Vec3 normal, TriangleMesh& mesh) {
  mesh.positions.push_back(positions_[at(corner.position)]);
  if (with_normals_) mesh.normals.push_back(normal);
  if (!with_tex_coords_) return;
  Vec2 uv = corner.tex_coord >= 0 ? file_.tex_coords[at(corner.tex_coord)] : Vec2{0, 0};
  if (options_.flip_tex_coords) uv.y = 1 - uv.y;
  mesh.uvs.push_back(uv);
}

std::uint32_t ObjMeshBuilder::shared_vertex(const ObjCorner& corner, TriangleMesh& mesh) {
  std::int32_t& first = first_vertex_[at(corner.position)];
  for (std::int32_t i = first; i >= 0; i = vertices_[at(i)].next) {
    if (vertices_[at(i)].corner == corner) return static_cast<std::uint32_t>(i);
  }
  // Flat faces of a mesh with normals add vertices that are not shared: keep the numbers in step.
  vertices_.resize(mesh.positions.size());
  const auto index = static_cast<std::int32_t>(vertices_.size());
  vertices_.push_back({corner, first});
  first = index;
  add_vertex(corner, with_normals_ ? normals_[at(corner.normal)] : Vec3{}, mesh);
  return static_cast<std::uint32_t>(index);
}

void ObjMeshBuilder::forget_vertices() {
  for (const Vertex& v : vertices_) {
    if (v.corner.position >= 0) first_vertex_[at(v.corner.position)] = -1;
  }
  vertices_.clear();
}

ObjMesh ObjMeshBuilder::build(std::span<const std::uint32_t> triangles) {
  ObjMesh result;
  TriangleMesh& mesh = result.mesh;
  with_normals_ = wants_normals(triangles);
  with_tex_coords_ = wants_tex_coords(triangles);
  for (const std::uint32_t t : triangles) {
    std::array<ObjCorner, 3> c = file_.triangles[t].corners;
    if (mirrored_) std::swap(c[1], c[2]);
    const Vec3 p0 = positions_[at(c[0].position)], p1 = positions_[at(c[1].position)];
    const Vec3 p2 = positions_[at(c[2].position)];
    if (!has_area(p0, p1, p2)) {
      ++result.degenerate_triangles;
      continue;
    }
    const bool flat = with_normals_ && !has_normals(file_.triangles[t]);
    const Vec3 facet = flat ? direction(area_vector(p0, p1, p2)) : Vec3{};
    std::array<std::uint32_t, 3> indices;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!with_normals_) c[k].normal = -1;
      indices[k] = flat ? static_cast<std::uint32_t>(mesh.positions.size()) : 0;
      if (flat) add_vertex(c[k], facet, mesh);
      if (!flat) indices[k] = shared_vertex(c[k], mesh);
    }
    mesh.triangles.push_back(indices);
  }
  forget_vertices();
  const bool smooth = options_.missing_normals == MissingNormals::smooth;
  if (smooth && !with_normals_ && !options_.ignore_normals) compute_smooth_normals(mesh);
  return result;
}

ObjMesh load_obj_mesh(const ObjFile& file, const MeshOptions& options) {
  ObjMeshBuilder builder(file, {.to_world = options.to_world,
                                .ignore_normals = options.face_normals,
                                .missing_normals = MissingNormals::smooth,
                                .flip_tex_coords = options.flip_tex_coords});
  std::vector<std::uint32_t> all(file.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  ObjMesh result = builder.build(all);
  if (result.mesh.triangles.empty()) {
    throw Error(fmt::format("{}: all {} triangles have no area", file.path, all.size()));
  }
  result.warnings = file.warnings;
  result.hash = file.hash;
  if (result.degenerate_triangles > 0) {
    result.warnings.push_back(fmt::format("{}: {} triangles without area are left out", file.path,
                                          result.degenerate_triangles));
  }
  return result;
}

}  // namespace octolux
