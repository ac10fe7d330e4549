// From an OBJ file to triangle meshes in world space. Vertices are shared where position, texture
// coordinate and normal are all the same; triangles without area are dropped; a map that mirrors
// keeps each surface's front side in front (normals go with the inverse transpose, windings are
// turned round).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/affine.h"
#include "core/shape.h"
#include "renderer/mesh_normals.h"
#include "renderer/obj_file.h"

namespace octolux {

struct ObjMesh {
  TriangleMesh mesh;
  std::size_t degenerate_triangles = 0;  // had no area; left out
  std::vector<std::string> warnings;     // what was ignored, degenerate triangles included
  std::uint64_t hash = 0;                // of the file's bytes
};

/// The whole file as one mesh, for the `obj` shape of Mitsuba XML; materials are ignored. Normals
/// as in Mitsuba 3: none with `face_normals`; otherwise the file's; if the file uses none, smooth
/// ones (compute_smooth_normals). Of `options` all but creases and flipping. Throws Error, also if
/// no triangle has area.
ObjMesh load_obj_mesh(const ObjFile& file, const MeshOptions& options);

/// How faces without normals of their own are shaded. In a mesh in which other faces do have
/// normals they are always flat.
enum class MissingNormals { flat, smooth };

struct ObjMeshOptions {
  Affine to_world;
  bool ignore_normals = false;
  MissingNormals missing_normals = MissingNormals::flat;
  bool flip_tex_coords = true;  // v upwards in the file, downwards in our textures (as in Mitsuba)
};

/// Makes meshes of parts of one file. Not thread-safe (it keeps its scratch space).
class ObjMeshBuilder {
 public:
  /// `file` must outlive the builder. Throws Error if the map is singular or a vertex leaves float.
  ObjMeshBuilder(const ObjFile& file, const ObjMeshOptions& options);

  /// The mesh of some of the file's triangles; empty if none of them has area.
  ObjMesh build(std::span<const std::uint32_t> triangles);

 private:
  struct Vertex {
    ObjCorner corner;
    std::int32_t next = -1;  // the next vertex of this mesh with the same position
  };

  bool wants_normals(std::span<const std::uint32_t> triangles) const;
  bool wants_tex_coords(std::span<const std::uint32_t> triangles) const;
  bool has_normals(const ObjTriangle& triangle) const;
  std::uint32_t shared_vertex(const ObjCorner& corner, TriangleMesh& mesh);
  void add_vertex(const ObjCorner& corner, Vec3 normal, TriangleMesh& mesh);
  void forget_vertices();

  const ObjFile& file_;
  ObjMeshOptions options_;
  bool mirrored_ = false;
  std::vector<Vec3> positions_;  // of the file, in world space
  std::vector<Vec3>
      normals_;  // of the file, in world space, unit; 0 where the file has no direction
  std::vector<std::int32_t> first_vertex_;  // per position of the file, or -1
  std::vector<Vertex> vertices_;            // of the mesh being built
  bool with_normals_ = false;               // does the mesh being built carry normals,
  bool with_tex_coords_ = false;            // and texture coordinates?
};

}  // namespace octolux
