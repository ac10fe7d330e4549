// A PLY file as a triangle mesh in the file's own space.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/shape.h"

namespace octolux {

struct PlyMesh {
  TriangleMesh mesh;                  // at least one triangle; all numbers finite
  std::vector<std::string> warnings;  // what was ignored
};

/// Understands of `vertex` x y z, nx ny nz, u v (or s t, texture_u texture_v) and of `face`
/// vertex_indices (or vertex_index), polygons cut into triangles. Other properties become mesh
/// attributes if asked for in `attributes`, named as in Mitsuba 3: r g b (or red green blue) of
/// `vertex` are "vertex_color", p_0 p_1 p_2 of `face` are "face_p"; integers are divided by the
/// largest of their type and decoded as sRGB. Throws Error with the path and the line, or the
/// number of the vertex or face: counts that do not fit the data, numbers that are not finite,
/// indices out of range, attributes that are not there.
PlyMesh read_ply(const std::string& path, std::string_view bytes,
                 const std::vector<std::string>& attributes);

}  // namespace octolux
