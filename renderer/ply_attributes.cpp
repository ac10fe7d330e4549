// ply_attributes.h. Pure functions.
#include "renderer/ply_attributes.h"

#include <algorithm>
#include <iterator>

#include "core/spectrum.h"

namespace octolux {
namespace {

constexpr const char* kReserved[] = {"x", "y", "z", "nx", "ny",        "nz",
                                     "u", "v", "s", "t",  "texture_u", "texture_v"};
constexpr const char* kColor[] = {"r", "g", "b", "a", "red", "green", "blue", "alpha"};

template <std::size_t size>
bool is_one_of(const char* const (&names)[size], const std::string& name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// What the attribute is called that a property belongs to, without the element's name.
std::string prefix_of(const std::string& property) {
  if (is_one_of(kColor, property)) return "color";
  const std::size_t underscore = property.size() - 2;
  const bool numbered =
      property.size() > 2 && property[underscore] == '_' &&
      std::string_view("01234xyzwrgba").find(property.back()) != std::string::npos;
  return numbered ? property.substr(0, underscore) : property;
}

}  // namespace

std::vector<PlyAttribute> list_attributes(const PlyElement& element) {
  std::vector<PlyAttribute> attributes;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.count_type || is_one_of(kReserved, property.name)) continue;
    const std::string name = element.name + "_" + prefix_of(property.name);
    const auto known = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const PlyAttribute& a) { return a.name == name; });
    PlyAttribute& attribute =
        known != attributes.end()
            ? *known
            : attributes.emplace_back(PlyAttribute{name, {}, largest(property.type)});
    attribute.columns.push_back(static_cast<int>(i));
  }
  return attributes;
}

Rgb PlyAttribute::value(std::span<const double> row) const {
  const auto channel = [&](std::size_t i) {
    if (i >= columns.size()) return 0.0f;
    const double raw = row[static_cast<std::size_t>(columns[i])];
    return scale > 0 ? srgb_to_linear(static_cast<float>(raw / scale)) : static_cast<float>(raw);
  };
  if (columns.size() == 1) return Rgb(channel(0));
  return {channel(0), channel(1), channel(2)};
}

}  // namespace octolux
