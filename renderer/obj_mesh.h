// A Wavefront OBJ file as one mesh.
#pragma once

#include <cstddef>
#include <string>

#include "core/affine.h"
#include "core/shape.h"

namespace octolux {

struct ObjMesh {
  TriangleMesh mesh;
  std::size_t degenerate_triangles = 0;
};

/// The whole file as one mesh. Throws Error.
ObjMesh load_obj_mesh(const std::string& path, const Affine& to_world, bool face_normals,
                      bool flip_tex_coords);

}  // namespace octolux
