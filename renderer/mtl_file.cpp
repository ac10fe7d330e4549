// A pass over the lines for what tinyobjloader does not tell, then tinyobjloader; see mtl_file.h.
#include "renderer/mtl_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <map>
#include <sstream>

#include "core/error.h"
#include "core/file_io.h"
#include "core/hash.h"
#include "renderer/obj_text.h"

namespace octolux {
namespace {

constexpr const char* kColours[] = {"Ka", "Kd", "Ks", "Ke", "Tf", "Kt"};
constexpr const char* kNumbers[] = {"Ns", "Ni", "d", "Tr", "illum"};
constexpr const char* kMaps[] = {"map_Kd",   "map_Ks", "map_Ns", "map_d",  "map_Ke",   "map_bump",
                                 "map_Bump", "bump",   "norm",   "map_Ka", "map_disp", "map_Disp",
                                 "disp",     "refl",   "map_Pr", "map_Pm", "map_Ps"};

template <std::size_t N>
bool contains(const char* const (&list)[N], std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

std::vector<std::string> split(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// A finite number at the start of `words[i]`, or an Error.
double number(const std::vector<std::string>& words, std::size_t i, const std::string& place) {
  double value = 0;
  if (i < words.size()) {
    const std::string& word = words[i];
    const char* begin = word.data() + (word[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
    const bool whole = end == word.data() + word.size();
    if (error == std::errc() && whole && std::isfinite(static_cast<float>(value))) return value;
  }
  throw Error(fmt::format("{}: {} needs {}", place, words[0],
                          contains(kColours, words[0]) ? "one or three numbers" : "a number"));
}

/// What the lines tell and tinyobjloader does not.
struct Scan {
  struct Entry {
    std::string place;
    std::set<std::string> given;
    std::set<std::string> grey;  // colours written as a single number, which means all three
    std::vector<MtlMap> maps;
  };
  std::map<std::string, Entry> entries;        // by name; the first of a name counts
  std::map<std::string, std::string> unknown;  // key, place where it first occurs
};

/// Checks a statement and notes it.
void scan_statement(const std::string& line, const std::string& place, Scan& scan,
                    Scan::Entry& entry) {
  const std::vector<std::string> words = split(line);
  const std::string& key = words[0];
  entry.given.insert(key);
  if (contains(kColours, key)) {
    const bool single = words.size() < 3 || words[2][0] == '#';
    for (std::size_t i = 1; i <= (single ? 1u : 3u); ++i) {
      if (number(words, i, place) < 0) throw Error(place + ": " + key + " must not be negative");
    }
    if (single) entry.grey.insert(key);
  } else if (contains(kNumbers, key)) {
    number(words, 1, place);
  } else if (contains(kMaps, key)) {
    std::string name;
    tinyobj::texture_option_t options{};
    options.scale[0] = options.scale[1] = options.scale[2] = options.bump_multiplier = 1;
    tinyobj::ParseTextureNameAndOption(&name, &options, line.substr(key.size()).c_str());
    const auto& [u, v, w] = options.scale;
    entry.maps.push_back({.key = key,
                          .file = name,
                          .scale = {u, v},
                          .offset = {options.origin_offset[0], options.origin_offset[1]},
                          .clamp = options.clamp,
                          .bump = options.bump_multiplier});
  } else {
    scan.unknown.try_emplace(key, place);
  }
}

Scan scan_lines(const std::string& text, const std::string& path) {
  Scan scan;
  Scan::Entry before_first, *entry = &before_first;
  std::istringstream in(text);
  std::size_t line_number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string place = fmt::format("{}:{}", path, ++line_number);
    const std::string statement(trim(line));
    if (statement.empty() || statement[0] == '#') continue;
    if (split(statement)[0] != "newmtl") {
      scan_statement(statement, place, scan, *entry);
      continue;
    }
    const std::string name(trim(statement.substr(6)));
    if (name.empty()) throw Error(place + ": newmtl needs a name");
    Scan::Entry fresh;
    fresh.place = place;
    const auto [it, added] = scan.entries.try_emplace(name, std::move(fresh));
    before_first = {};
    entry = added ? &it->second : &before_first;  // a second material of that name is not used
  }
  return scan;
}

Rgb colour(const tinyobj::real_t (&c)[3], bool grey) {
  return grey ? Rgb(c[0]) : Rgb(c[0], c[1], c[2]);
}

MtlMaterial convert(const tinyobj::material_t& m, const std::string& name,
                    const Scan::Entry& entry) {
  const auto grey = [&](const char* key) { return entry.grey.contains(key); };
  MtlMaterial result;
  result.name = name;
  result.place = entry.place;
  result.given = entry.given;
  result.maps = entry.maps;
  if (entry.given.contains("Kd")) result.kd = colour(m.diffuse, grey("Kd"));
  result.ks = colour(m.specular, grey("Ks"));
  result.ke = colour(m.emission, grey("Ke"));
  result.tf = colour(m.transmittance, grey("Tf") || grey("Kt"));
  result.ns = std::max(m.shininess, 0.0f);
  result.ni = m.ior > 0 ? m.ior : 1;
  result.opacity = std::clamp(m.dissolve, 0.0f, 1.0f);
  if (entry.given.contains("illum")) result.illum = m.illum;
  return result;
}

}  // namespace

MtlFile read_mtl_file(const std::string& path) {
  std::string text = read_file(path);
  MtlFile file;
  file.hash = hash_bytes(0, text);
  unify_line_breaks(text);
  Scan scan = scan_lines(text, path);

  std::map<std::string, int> index_of_name;
  std::vector<tinyobj::material_t> materials;
  std::istringstream in(text);
  std::string warning, error;
  tinyobj::LoadMtl(&index_of_name, &materials, &in, &warning, &error);
  for (const tinyobj::material_t& m : materials) {
    const std::string name(trim(m.name));
    auto entry = scan.entries.extract(name);  // so that the first of a name counts
    if (!entry.empty()) file.materials.push_back(convert(m, name, entry.mapped()));
  }
  for (const auto& [key, place] : scan.unknown) {
    file.warnings.push_back(fmt::format("{}: unknown key '{}' is ignored", place, key));
  }
  return file;
}

}  // namespace octolux
