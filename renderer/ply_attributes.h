// Which properties of a PLY element make up which mesh attribute.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/rgb.h"
#include "renderer/ply_header.h"

namespace octolux {

/// One attribute: up to four properties of its element, in order.
struct PlyAttribute {
  std::string name;          // "vertex_color"
  std::vector<int> columns;  // indices of the properties
  double scale = 0;  // integers are divided by this and decoded as sRGB; 0: taken as they are

  /// From the values of all the element's properties. One value is grey, the fourth is not used.
  Rgb value(std::span<const double> row) const;
};

/// All there are, in the file's order, without positions, normals, texture coordinates and lists.
/// Properties p_0 p_1 p_2 (or _1 _2 _3, _x _y _z, _r _g _b) belong together, and r g b, red green
/// blue make "color" (Mitsuba 3). The names begin with the element's.
std::vector<PlyAttribute> list_attributes(const PlyElement& element);

}  // namespace octolux
