// The header of a PLY file: which elements with which properties follow, and how they are written
// (G. Turk, "The PLY Polygon File Format", 1994). Own code, because Debian has no PLY library
// smaller than a whole mesh toolkit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octolux {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyFormat { ascii, little_endian, big_endian };

/// Bytes of a value in the binary formats.
std::size_t size_of(PlyType type);
/// Largest value of an integer type; 0 for the floating ones.
double largest(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;    // of the values
  std::optional<PlyType> count_type;  // of the number of values before them; none: one value
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of the property with one of these names, or -1.
  int find(std::initializer_list<const char*> legal) const;
  /// Fewest bytes that one of them takes in this format.
  std::size_t least_size(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  // [bytes]; the body begins there
};

/// Throws Error "path:line: what is wrong".
PlyHeader read_ply_header(const std::string& path, std::string_view bytes);

}  // namespace octolux
