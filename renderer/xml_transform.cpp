// The elements of a <transform>, in both spellings. p' = T_n ... T_2 T_1 p for elements 1 to n.
#include <string>

#include "renderer/xml_values.h"

namespace octolux {
namespace {

struct Triple {
  double x, y, z;
};

/// value="a" or "a, b, c", or attributes x, y, z that default to `absent`.
Triple parse_triple(const XmlNode& node, double absent) {
  if (const std::string* value = node.attribute("value")) {
    const std::vector<double> n = parse_numbers(*value, node.where);
    if (n.size() == 1 && node.tag == "scale") return {n[0], n[0], n[0]};
    if (n.size() != 3) fail(node.where, "'" + *value + "' does not have three numbers");
    return {n[0], n[1], n[2]};
  }
  const auto axis = [&](const char* name) {
    const std::string* text = node.attribute(name);
    return text ? parse_number(*text, node.where) : absent;
  };
  return {axis("x"), axis("y"), axis("z")};
}

Affine parse_translate(const XmlNode& node) {
  const Triple t = parse_triple(node, 0);
  return translation(t.x, t.y, t.z);
}

Affine parse_scale(const XmlNode& node) {
  const Triple s = parse_triple(node, 1);
  return scaling(s.x, s.y, s.z);
}

Affine parse_rotate(const XmlNode& node) {
  const Triple axis = parse_triple(node, 0);
  if (axis.x == 0 && axis.y == 0 && axis.z == 0) fail(node.where, "<rotate> needs an axis");
  return rotation(axis.x, axis.y, axis.z, parse_number(node.required("angle"), node.where));
}

Affine parse_matrix(const XmlNode& node) {
  const std::vector<double> n = parse_numbers(node.required("value"), node.where);
  if (n.size() != 16 && n.size() != 9) {
    fail(node.where,
         "<matrix> needs 16 or 9 numbers, row by row; there are " + std::to_string(n.size()));
  }
  const std::size_t columns = n.size() == 16 ? 4 : 3;
  Affine result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < columns; ++j) result.m[i][j] = n[i * columns + j];
  }
  const bool affine = columns == 3 || (n[12] == 0 && n[13] == 0 && n[14] == 0 && n[15] == 1);
  if (!affine) fail(node.where, "the last row of <matrix> must be 0 0 0 1");
  return result;
}

Affine parse_look_at(const XmlNode& node) {
  const auto read = [&](const char* name) {
    XmlNode vector{node.where, name, {{"value", node.required(name)}}, {}};
    return parse_vector(vector);
  };
  const std::optional<Affine> result = look_at(read("origin"), read("target"), read("up"));
  if (!result) {
    fail(node.where,
         "<lookat>: 'origin' and 'target' must differ, and 'up' must not be parallel "
         "to the view");
  }
  return *result;
}

struct Element {
  const char* tag;
  Affine (*parse)(const XmlNode&);
};

constexpr Element kElements[] = {
    {"translate", parse_translate}, {"scale", parse_scale},    {"rotate", parse_rotate},
    {"matrix", parse_matrix},       {"lookat", parse_look_at}, {"lookAt", parse_look_at},
};

}  // namespace

Affine parse_transform(const XmlNode& node) {
  Affine result;
  for (const XmlNode& child : node.children) {
    const Element* found = nullptr;
    for (const Element& element : kElements) {
      if (child.tag == element.tag) found = &element;
    }
    if (!found) {
      fail(child.where, "<" + child.tag +
                            "> cannot stand inside <transform>; legal: translate, scale, rotate, "
                            "matrix, lookat");
    }
    result = found->parse(child) * result;
  }
  return result;
}

}  // namespace octolux
