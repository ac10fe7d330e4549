// tinyobjloader's callbacks, and the checks it does not make; see obj_file.h.
#include "renderer/obj_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <charconv>
#include <cmath>
#include <istream>
#include <span>
#include <streambuf>
#include <unordered_map>

#include "core/error.h"
#include "renderer/obj_text.h"
#include "renderer/polygon.h"

namespace octolux {
namespace {

/// Bytes in memory as a stream that tells how far it has been read.
class MemoryBuffer : public std::streambuf {
 public:
  explicit MemoryBuffer(std::string& text) {
    setg(text.data(), text.data(), text.data() + text.size());
  }
  std::size_t position() const { return static_cast<std::size_t>(gptr() - eback()); }
};

/// The largest index of one kind that pointed past what had been read so far, and where.
struct ForwardReference {
  std::int64_t index = -1;
  std::size_t offset = 0;
};

/// Does a statement carry at least `count` finite numbers? (tinyobjloader reads others as 0.)
bool has_numbers(std::string_view line, int count) {
  const char* at = line.data();
  const char* const end = at + line.size();
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (at < end && blank(*at)) ++at;
  while (at < end && !blank(*at)) ++at;  // the keyword
  for (int i = 0; i < count; ++i) {
    while (at < end && blank(*at)) ++at;
    if (at < end && *at == '+') ++at;
    double value = 0;
    const auto [after, error] = std::from_chars(at, end, value);
    if (error == std::errc::invalid_argument || !std::isfinite(value)) return false;
    if (after < end && !blank(*after)) return false;
    at = after;
  }
  return true;
}

/// Is an index behind a slash written, but zero or no number? (tinyobjloader gives 0 for these and
/// for an index that is left out.)
bool has_bad_reference(std::string_view line) {
  for (std::size_t i = line.find('/'); i != std::string_view::npos; i = line.find('/', i + 1)) {
    const char after = i + 1 < line.size() ? line[i + 1] : ' ';
    if (after != '/' && after != ' ' && after != '\t' && after != '-' &&
        !(after >= '1' && after <= '9')) {
      return true;
    }
  }
  return false;
}

class Reader {
 public:
  explicit Reader(const std::string& path) : text_(path), buffer_(text_.text()) {}

  ObjFile read();

 private:
  void add_position(Vec3 p);
  void add_normal(Vec3 n);
  void add_tex_coord(Vec2 uv);
  void add_face(std::span<const tinyobj::index_t> raw);
  void use_material(const char* name);
  std::int32_t index(int raw, std::size_t count, const char* what, ForwardReference& forward);
  void check_forward(const ForwardReference& forward, std::size_t count, const char* what) const;
  void cut_into_triangles();
  void list_warnings();
  Error error(const std::string& message, std::size_t end) const {
    return Error(text_.place_before(end) + ": " + message);
  }
  Error error(const std::string& message) const { return error(message, buffer_.position()); }

  struct Face {
    std::size_t first = 0, size = 0;  // range of corners_
    std::int32_t material = -1;
  };

  ObjText text_;
  MemoryBuffer buffer_;
  ObjFile file_;
  std::vector<ObjCorner> corners_;
  std::vector<Face> faces_;
  std::unordered_map<std::string, std::int32_t> material_of_name_;
  std::int32_t material_ = -1;
  ForwardReference forward_position_, forward_tex_coord_, forward_normal_;
  std::size_t short_faces_ = 0;
};

void Reader::add_position(Vec3 p) {
  if (!is_finite(p) || !has_numbers(text_.line_before(buffer_.position()), 3)) {
    throw error("a vertex needs three finite numbers");
  }
  file_.positions.push_back(p);
}

void Reader::add_normal(Vec3 n) {
  if (!is_finite(n) || !has_numbers(text_.line_before(buffer_.position()), 3)) {
    throw error("a vertex normal needs three finite numbers");
  }
  file_.normals.push_back(n);
}

void Reader::add_tex_coord(Vec2 uv) {
  const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
  if (!finite || !has_numbers(text_.line_before(buffer_.position()), 1)) {
    throw error("a texture coordinate needs one to three finite numbers");
  }
  file_.tex_coords.push_back(uv);
}

std::int32_t Reader::index(int raw, std::size_t count, const char* what,
                           ForwardReference& forward) {
  const std::int64_t i = raw > 0 ? raw - 1 : static_cast<std::int64_t>(count) + raw;
  if (raw == 0 || i < 0) {
    throw error(fmt::format("face index {} is no {} ({} read so far)", raw, what, count));
  }
  if (i > forward.index && i >= static_cast<std::int64_t>(count)) {
    forward = {i, buffer_.position()};
  }
  return static_cast<std::int32_t>(i);
}

void Reader::add_face(std::span<const tinyobj::index_t> raw) {
  if (raw.size() < 3) {
    ++short_faces_;
    return;
  }
  faces_.push_back({corners_.size(), raw.size(), material_});
  bool something_missing = false;
  for (const tinyobj::index_t& r : raw) {
    ObjCorner corner;
    corner.position = index(r.vertex_index, file_.positions.size(), "vertex", forward_position_);
    if (r.texcoord_index != 0) {
      corner.tex_coord = index(r.texcoord_index, file_.tex_coords.size(), "texture coordinate",
                               forward_tex_coord_);
    }
    if (r.normal_index != 0) {
      corner.normal = index(r.normal_index, file_.normals.size(), "vertex normal", forward_normal_);
    }
    something_missing |= corner.tex_coord < 0 || corner.normal < 0;
    corners_.push_back(corner);
  }
  if (something_missing && has_bad_reference(text_.line_before(buffer_.position()))) {
    throw error("a face index must be a number other than 0");
  }
}

void Reader::use_material(const char* name) {
  const std::string key(trim(name));
  const auto next = static_cast<std::int32_t>(file_.material_names.size());
  const auto [entry, added] = material_of_name_.try_emplace(key, next);
  if (added) file_.material_names.push_back(key);
  material_ = entry->second;
}

void Reader::check_forward(const ForwardReference& forward, std::size_t count,
                           const char* what) const {
  if (forward.index < static_cast<std::int64_t>(count)) return;
  throw error(
      fmt::format("face index {} is no {} (the file has {})", forward.index + 1, what, count),
      forward.offset);
}

void Reader::cut_into_triangles() {
  std::vector<Vec3> polygon;
  for (const Face& face : faces_) {
    const std::span<const ObjCorner> corners(corners_.data() + face.first, face.size);
    if (face.size == 3) {
      file_.triangles.push_back({{corners[0], corners[1], corners[2]}, face.material});
      continue;
    }
    polygon.clear();
    for (const ObjCorner& c : corners) {
      polygon.push_back(file_.positions[static_cast<std::size_t>(c.position)]);
    }
    for (const auto& t : triangulate(polygon)) {
      file_.triangles.push_back({{corners[t[0]], corners[t[1]], corners[t[2]]}, face.material});
    }
  }
}

void Reader::list_warnings() {
  for (const auto& [word, line] : text_.ignored()) {
    const char* what = word == "p" ? " (points)" : word == "l" ? " (lines)" : "";
    file_.warnings.push_back(
        fmt::format("{}:{}: '{}'{} is ignored", text_.path(), line, word, what));
  }
  if (short_faces_ > 0) {
    file_.warnings.push_back(fmt::format("{}: {} faces with fewer than 3 corners are ignored",
                                         text_.path(), short_faces_));
  }
}

ObjFile Reader::read() {
  tinyobj::callback_t callbacks;
  using tinyobj::real_t;
  callbacks.vertex_cb = [](void* reader, real_t x, real_t y, real_t z, real_t) {
    static_cast<Reader*>(reader)->add_position({x, y, z});
  };
  callbacks.normal_cb = [](void* reader, real_t x, real_t y, real_t z) {
    static_cast<Reader*>(reader)->add_normal({x, y, z});
  };
  callbacks.texcoord_cb = [](void* reader, real_t u, real_t v, real_t) {
    static_cast<Reader*>(reader)->add_tex_coord({u, v});
  };
  callbacks.index_cb = [](void* reader, tinyobj::index_t* indices, int count) {
    static_cast<Reader*>(reader)->add_face({indices, static_cast<std::size_t>(count)});
  };
  callbacks.usemtl_cb = [](void* reader, const char* name, int) {
    static_cast<Reader*>(reader)->use_material(name);
  };
  std::istream in(&buffer_);
  tinyobj::LoadObjWithCallback(in, callbacks, this);

  check_forward(forward_position_, file_.positions.size(), "vertex");
  check_forward(forward_tex_coord_, file_.tex_coords.size(), "texture coordinate");
  check_forward(forward_normal_, file_.normals.size(), "vertex normal");
  if (faces_.empty()) {
    throw Error(
        fmt::format("{}: holds no faces; expected a Wavefront OBJ with `f` lines", text_.path()));
  }
  cut_into_triangles();
  list_warnings();
  file_.path = text_.path();
  file_.mtllibs = text_.mtllibs();
  file_.hash = text_.hash();
  return std::move(file_);
}

}  // namespace

ObjFile read_obj_file(const std::string& path) { return Reader(path).read(); }

}  // namespace octolux
