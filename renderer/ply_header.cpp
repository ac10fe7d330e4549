// One statement per line; see ply_header.h. Pure functions.
#include "renderer/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "core/error.h"

namespace octolux {
namespace {

struct TypeName {
  const char* name;
  PlyType type;
};

/// The original names and those that give the width.
constexpr TypeName kTypes[] = {
    {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64}};

struct FormatName {
  const char* name;
  PlyFormat format;
};
constexpr FormatName kFormats[] = {{"ascii", PlyFormat::ascii},
                                   {"binary_little_endian", PlyFormat::little_endian},
                                   {"binary_big_endian", PlyFormat::big_endian}};

template <typename Table>
std::vector<std::string> names_of(const Table& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.push_back(entry.name);
  return names;
}

class HeaderReader {
 public:
  HeaderReader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  PlyHeader read() {
    if (next_line() != "ply") fail("no PLY file: the first line must be 'ply'");
    bool has_format = false;
    while (true) {
      const std::vector<std::string> words = split(next_line());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        read_format(words);
        has_format = true;
      } else if (words[0] == "element") {
        read_element(words);
      } else if (words[0] == "property") {
        read_property(words);
      } else {
        fail(unknown_name("PLY header line", words[0],
                          {"comment", "element", "end_header", "format", "obj_info", "property"}));
      }
    }
    if (!has_format) fail("the header has no line 'format'");
    header_.size = at_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}:{}: {}", path_, line_, what));
  }

  std::string_view next_line() {
    const std::size_t end = bytes_.find('\n', at_);
    ++line_;
    if (end == std::string_view::npos) {
      fail(line_ == 1 ? "no PLY file: the first line must be 'ply'"
                      : "the file ends inside the header (no 'end_header')");
    }
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  static std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> words;
    while (true) {
      const std::size_t begin = line.find_first_not_of(" \t");
      if (begin == std::string_view::npos) return words;
      const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
      words.emplace_back(line.substr(begin, end - begin));
      line.remove_prefix(end);
    }
  }

  void read_format(const std::vector<std::string>& words) {
    if (words.size() != 3 || words[2] != "1.0") fail("expected 'format NAME 1.0'");
    for (const FormatName& f : kFormats) {
      if (words[1] != f.name) continue;
      header_.format = f.format;
      return;
    }
    fail(unknown_name("PLY format", words[1], names_of(kFormats)));
  }

  void read_element(const std::vector<std::string>& words) {
    PlyElement element;
    if (words.size() != 3) fail("expected 'element NAME COUNT'");
    element.name = words[1];
    const char* end = words[2].data() + words[2].size();
    const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
    if (error != std::errc() || stop != end) fail("'" + words[2] + "' is no count");
    header_.elements.push_back(std::move(element));
  }

  void read_property(const std::vector<std::string>& words) {
    if (header_.elements.empty()) fail("a 'property' before the first 'element'");
    const bool list = words.size() > 1 && words[1] == "list";
    if (words.size() != (list ? 5u : 3u)) {
      fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
    PlyProperty property{words.back(), type_of(words[list ? 3 : 1]), std::nullopt};
    if (list) property.count_type = type_of(words[2]);
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType type_of(const std::string& name) const {
    const auto* found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                     [&](const TypeName& t) { return name == t.name; });
    if (found == std::end(kTypes)) fail(unknown_name("PLY type", name, names_of(kTypes)));
    return found->type;
  }

  const std::string& path_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  int line_ = 0;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::float64:
      return 8;
    default:
      return 4;
  }
}

double largest(PlyType type) {
  if (type == PlyType::float32 || type == PlyType::float64) return 0;
  const bool has_sign = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
  const int bits = 8 * static_cast<int>(size_of(type)) - (has_sign ? 1 : 0);
  return static_cast<double>((std::uint64_t{1} << bits) - 1);
}

int PlyElement::find(std::initializer_list<const char*> legal) const {
  for (const char* wanted : legal) {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == wanted) return static_cast<int>(i);
    }
  }
  return -1;
}

std::size_t PlyElement::least_size(PlyFormat format) const {
  std::size_t size = 0;
  for (const PlyProperty& p : properties) {
    // In text a digit and a blank; the last blank of a file may be missing.
    size += format == PlyFormat::ascii ? 2 : size_of(p.count_type.value_or(p.type));
  }
  return size;
}

PlyHeader read_ply_header(const std::string& path, std::string_view bytes) {
  return HeaderReader(path, bytes).read();
}

}  // namespace octolux
