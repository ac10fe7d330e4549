// Mitsuba's own mesh files (`serialized`): several meshes, each deflated on its own, and a list of
// where each begins. Versions 3 and 4 (Mitsuba 0.5/0.6 manual, "Serialized mesh loader").
#pragma once

#include <string>
#include <string_view>

#include "core/shape.h"

namespace octolux {

struct SerializedMesh {
  TriangleMesh mesh;          // in the file's own space; all numbers finite
  bool face_normals = false;  // the file wants flat faces
};

/// Mesh number `index` of the file. `with_colors`: keep vertex colours, as "vertex_color". Throws
/// Error that begins with `path`: no such file, wrong version, no such mesh, broken compression,
/// counts that do not fit the data, numbers that are not finite, indices out of range.
SerializedMesh read_serialized(const std::string& path, std::string_view bytes, int index,
                               bool with_colors);

}  // namespace octolux
