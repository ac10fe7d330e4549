// The body of a PLY file: rows of numbers, per element. Vertices and faces may come in any order,
// so faces are kept as lists of corners until everything is read. See ply_file.h.
#include "renderer/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/error.h"
#include "renderer/mesh_normals.h"
#include "renderer/ply_attributes.h"
#include "renderer/ply_header.h"
#include "renderer/ply_values.h"
#include "renderer/polygon.h"

namespace octolux {
namespace {

constexpr std::uint64_t kMostItems = std::numeric_limits<std::int32_t>::max();

/// Numbers of one element's row, in the order of its properties; a list counts as 0.
using Row = std::vector<double>;

/// Columns of a row that make a vector; -1 where there is none.
template <std::size_t size>
using Columns = std::array<int, size>;

template <std::size_t size>
bool has(const Columns<size>& columns) {
  return std::all_of(columns.begin(), columns.end(), [](int c) { return c >= 0; });
}

template <typename Source>
class BodyReader {
 public:
  BodyReader(const std::string& path, std::string_view bytes, const PlyHeader& header)
      : path_(path),
        bytes_(bytes),
        header_(header),
        source_(bytes.substr(header.size)),
        left_(bytes.size() - header.size) {}

  PlyMesh read(const std::vector<std::string>& attributes) {
    for (const PlyElement& element : header_.elements) {
      check_size(element);
      if (element.name == "vertex") {
        read_vertices(element, attributes);
      } else if (element.name == "face") {
        read_faces(element, attributes);
      } else {
        for (index_ = 0; index_ < element.count; ++index_) read_row(element, -1);
        warn(fmt::format("{}: the element '{}' is ignored", path_, element.name));
      }
    }
    element_ = nullptr;
    if (!source_.at_end()) fail("there is data behind the last element; a count is too small");
    cut_polygons();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    std::string where = path_;
    if (header_.format == PlyFormat::ascii) {
      const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(
                                            header_.size + source_.position(), bytes_.size()));
      where += ":" + std::to_string(1 + std::count(bytes_.begin(), end, '\n'));
    }
    if (element_) where += fmt::format(": {} {} of {}", element_->name, index_, element_->count);
    throw Error(where + ": " + what);
  }
  void warn(const std::string& text) { result_.warnings.push_back(text); }

  /// Before any memory is asked for.
  void check_size(const PlyElement& element) {
    element_ = &element;
    row_.assign(element.properties.size(), 0);
    index_ = 0;
    if (element.count > kMostItems) fail("more than 2^31 of them");
    const std::size_t least = std::max<std::size_t>(1, element.least_size(header_.format));
    const std::size_t left = left_ - source_.position() + 1;
    if (element.count > left / least) {
      fail(fmt::format("the file ends early: {} bytes are left for {} of them", left - 1,
                       element.count));
    }
  }

  double next(const PlyProperty& property, PlyType type) {
    const std::optional<double> value = source_.next(type);
    if (value) return *value;
    fail(source_.at_end() ? "the file ends here" : "'" + property.name + "' is not a number");
  }

  /// Reads a row into row_, and the list in column `list` into list_.
  void read_row(const PlyElement& element, int list) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (!property.count_type) {
        row_[i] = next(property, property.type);
        continue;
      }
      const double count = next(property, *property.count_type);
      if (!(count >= 0 && count <= 0x1p31 && count == std::floor(count))) {
        fail(fmt::format("'{}' has the length {}", property.name, count));
      }
      const bool wanted = static_cast<int>(i) == list;
      if (wanted) list_.clear();
      for (double k = 0; k < count; ++k) {
        const double value = next(property, property.type);
        if (wanted) list_.push_back(value);
      }
    }
  }

  float number(int column) const {
    const auto i = static_cast<std::size_t>(column);
    const auto value = static_cast<float>(row_[i]);
    if (!std::isfinite(value)) {
      fail(fmt::format("'{}' is not a finite number", element_->properties[i].name));
    }
    return value;
  }
  Vec3 vector(const Columns<3>& c) const { return {number(c[0]), number(c[1]), number(c[2])}; }

  /// Those of this element that are asked for.
  std::vector<PlyAttribute> choose(const PlyElement& element,
                                   const std::vector<std::string>& wanted) {
    std::vector<PlyAttribute> chosen;
    for (PlyAttribute& a : list_attributes(element)) {
      known_.push_back(a.name);
      if (std::find(wanted.begin(), wanted.end(), a.name) == wanted.end()) continue;
      result_.mesh.attributes.push_back({a.name, element.name == "face", {}});
      chosen.push_back(std::move(a));
    }
    return chosen;
  }

  void add_attributes(const std::vector<PlyAttribute>& chosen, std::size_t first) {
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      for (const int column : chosen[k].columns) number(column);
      result_.mesh.attributes[first + k].values.push_back(chosen[k].value(row_));
    }
  }

  void read_vertices(const PlyElement& element, const std::vector<std::string>& wanted) {
    const Columns<3> p{element.find({"x"}), element.find({"y"}), element.find({"z"})};
    const Columns<3> n{element.find({"nx"}), element.find({"ny"}), element.find({"nz"})};
    const Columns<2> uv{element.find({"u", "texture_u", "s"}),
                        element.find({"v", "texture_v", "t"})};
    if (!has(p)) fail("expected the properties 'x', 'y' and 'z'");
    const std::size_t first = result_.mesh.attributes.size();
    const std::vector<PlyAttribute> attributes = choose(element, wanted);
    TriangleMesh& mesh = result_.mesh;
    for (index_ = 0; index_ < element.count; ++index_) {
      read_row(element, -1);
      mesh.positions.push_back(vector(p));
      if (has(n)) mesh.normals.push_back(vector(n));
      if (has(uv)) mesh.uvs.push_back({number(uv[0]), number(uv[1])});
      add_attributes(attributes, first);
    }
  }

  void read_faces(const PlyElement& element, const std::vector<std::string>& wanted) {
    const int list = element.find({"vertex_indices", "vertex_index"});
    if (list < 0 || !element.properties[static_cast<std::size_t>(list)].count_type) {
      fail("expected a property list 'vertex_indices'");
    }
    const std::size_t first = result_.mesh.attributes.size();
    const std::vector<PlyAttribute> attributes = choose(element, wanted);
    for (index_ = 0; index_ < element.count; ++index_) {
      read_row(element, list);
      for (const double value : list_) {
        if (!(value >= 0 && value <= 0x1p32 && value == std::floor(value))) {
          fail(fmt::format("{} is no index of a vertex", value));
        }
        corners_.push_back(static_cast<std::uint32_t>(value));
      }
      sizes_.push_back(static_cast<std::uint32_t>(list_.size()));
      add_attributes(attributes, first);
    }
  }

  void cut_polygons() {
    TriangleMesh& mesh = result_.mesh;
    std::vector<std::uint32_t> face_of_triangle;
    std::size_t short_faces = 0;
    std::vector<Vec3> polygon;
    const std::uint32_t* corner = corners_.data();
    for (std::uint32_t face = 0; face < sizes_.size(); corner += sizes_[face++]) {
      const std::span<const std::uint32_t> corners(corner, sizes_[face]);
      polygon.clear();
      for (const std::uint32_t c : corners) polygon.push_back(position(c, face));
      if (corners.size() < 3) {
        ++short_faces;
        continue;
      }
      if (corners.size() == 3) {
        mesh.triangles.push_back({corners[0], corners[1], corners[2]});
      } else {
        for (const auto& t : triangulate(polygon)) {
          mesh.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
        }
      }
      face_of_triangle.resize(mesh.triangles.size(), face);
    }
    if (short_faces > 0) {
      warn(fmt::format("{}: {} faces with fewer than 3 corners are ignored", path_, short_faces));
    }
    if (mesh.triangles.empty()) fail("holds no faces");
    spread_face_attributes(mesh, face_of_triangle);
  }

  Vec3 position(std::uint32_t vertex, std::uint32_t face) const {
    const std::vector<Vec3>& all = result_.mesh.positions;
    if (vertex < all.size()) return all[vertex];
    throw Error(fmt::format("{}: face {}: the index {} is out of range; the file has {} vertices",
                            path_, face, vertex, all.size()));
  }

 public:
  /// All attributes of the file, asked for or not.
  const std::vector<std::string>& known_attributes() const { return known_; }

 private:
  const std::string& path_;
  std::string_view bytes_;
  const PlyHeader& header_;
  Source source_;
  std::size_t left_;  // bytes of the body
  const PlyElement* element_ = nullptr;
  std::uint64_t index_ = 0;  // of the row being read
  Row row_, list_;
  std::vector<std::uint32_t> corners_, sizes_;  // of the faces
  std::vector<std::string> known_;
  PlyMesh result_;
};

template <typename Source>
PlyMesh read_body(const std::string& path, std::string_view bytes, const PlyHeader& header,
                  const std::vector<std::string>& attributes) {
  BodyReader<Source> reader(path, bytes, header);
  PlyMesh result = reader.read(attributes);
  for (const std::string& name : attributes) {
    const auto& known = reader.known_attributes();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw Error(path + ": " + unknown_name("mesh attribute", name, known));
  }
  return result;
}

}  // namespace

PlyMesh read_ply(const std::string& path, std::string_view bytes,
                 const std::vector<std::string>& attributes) {
  const PlyHeader header = read_ply_header(path, bytes);
  const bool little = std::endian::native == std::endian::little;
  if (header.format == PlyFormat::ascii) {
    return read_body<PlyText>(path, bytes, header, attributes);
  }
  return (header.format == PlyFormat::little_endian) == little
             ? read_body<PlyBytes<false>>(path, bytes, header, attributes)
             : read_body<PlyBytes<true>>(path, bytes, header, attributes);
}

}  // namespace octolux
