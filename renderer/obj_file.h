// What an OBJ file says: vertices, polygons cut into triangles, material names; parsed by
// tinyobjloader, checked by us. tinyobjloader turns what it cannot read into zeros and drops faces
// with wrong indices; here both are errors that name the line. Nothing is transformed or merged
// yet (obj_mesh.h does that).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.h"

namespace octolux {

/// Indices into ObjFile's lists, from 0; -1 where the file gives none.
struct ObjCorner {
  std::int32_t position = -1, tex_coord = -1, normal = -1;
};
constexpr bool operator==(const ObjCorner& a, const ObjCorner& b) {
  return a.position == b.position && a.tex_coord == b.tex_coord && a.normal == b.normal;
}

struct ObjTriangle {
  std::array<ObjCorner, 3> corners;
  std::int32_t material = -1;  // index into material_names, or -1 before any `usemtl`
};

struct ObjFile {
  std::string path;
  std::vector<Vec3> positions;  // finite
  std::vector<Vec3> normals;    // as written: any length, perhaps 0; finite
  std::vector<Vec2> tex_coords;
  std::vector<ObjTriangle> triangles;       // in the file's order; at least one
  std::vector<std::string> material_names;  // in the order of their first use
  std::vector<std::string> mtllibs;         // what follows `mtllib`, per line
  std::vector<std::string> warnings;        // what was ignored
  std::uint64_t hash = 0;                   // of the file's bytes
};

/// Throws Error, "path:line: what is wrong", for a file without faces, a coordinate that is not a
/// finite number, an index out of range.
ObjFile read_obj_file(const std::string& path);

}  // namespace octolux
