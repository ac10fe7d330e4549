// serialized_file.h, inflated by zlib while it is read. All numbers in the file are little-endian.
#include "renderer/serialized_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"

namespace octolux {
namespace {

constexpr std::uint16_t kMagic = 0x041C;
constexpr std::size_t kHeaderSize = 4;  // magic and version

enum Flags : std::uint32_t {
  kHasNormals = 0x0001,
  kHasTexCoords = 0x0002,
  kHasColors = 0x0008,
  kFaceNormals = 0x0010,
  kDoublePrecision = 0x2000,
};

template <typename T>
T from_little_endian(const char* bytes) {
  char ordered[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    ordered[i] = bytes[std::endian::native == std::endian::little ? i : sizeof(T) - 1 - i];
  }
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return value;
}

/// The bytes behind a zlib stream.
class Inflater {
 public:
  Inflater(std::string_view compressed, std::string where) : where_(std::move(where)) {
    // zlib's older interface wants a pointer to non-const; it only reads.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));
    left_ = compressed.size();
    if (inflateInit(&stream_) != Z_OK) fail("zlib cannot start");
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  [[noreturn]] void fail(const std::string& what) const { throw Error(where_ + ": " + what); }

  void read(char* out, std::size_t size) {
    while (size > 0) {
      const auto room = static_cast<uInt>(std::min(size, kChunk));
      stream_.next_out = reinterpret_cast<Bytef*>(out);
      stream_.avail_out = room;
      const int code = step();
      const std::size_t made = room - stream_.avail_out;
      out += made;
      size -= made;
      if (made > 0 || code == Z_OK) continue;
      fail(code == Z_STREAM_END || code == Z_BUF_ERROR
               ? "the data ends early; a count is too large or the file is cut off"
               : fmt::format("broken zlib data ({})", stream_.msg ? stream_.msg : "no reason"));
    }
  }

  template <typename T>
  T value() {
    char bytes[sizeof(T)];
    read(bytes, sizeof(T));
    return from_little_endian<T>(bytes);
  }

  /// So many bytes that follow cannot be in what is left.
  bool cannot_hold(double size) const {
    constexpr double kBestRatio = 1040;  // deflate: at most 1032 to 1
    return size > kBestRatio * (static_cast<double>(left_ + stream_.avail_in) + 64) + 65536;
  }

 private:
  static constexpr std::size_t kChunk = std::size_t{1} << 30;

  int step() {
    if (stream_.avail_in == 0) {
      stream_.avail_in = static_cast<uInt>(std::min(left_, kChunk));
      left_ -= stream_.avail_in;
    }
    return inflate(&stream_, Z_NO_FLUSH);
  }

  std::string where_;
  z_stream stream_{};
  std::size_t left_ = 0;  // compressed bytes not yet given to zlib
};

class Reader {
 public:
  Reader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  SerializedMesh read(int index, bool with_colors) {
    const std::uint16_t version = check_header(0);
    const auto [begin, end] = extent(index, version);
    check_header(begin);
    Inflater in(bytes_.substr(begin + kHeaderSize, end - begin - kHeaderSize),
                fmt::format("{}: mesh {}", path_, index));
    const auto flags = in.value<std::uint32_t>();
    if (version >= 4) {
      while (in.value<char>() != '\0') continue;  // the mesh's name
    }
    const auto vertices = in.value<std::uint64_t>();
    const auto triangles = in.value<std::uint64_t>();
    const double width = flags & kDoublePrecision ? 8 : 4;
    const double size =
        3 * width * static_cast<double>(vertices) + 12.0 * static_cast<double>(triangles);
    if (in.cannot_hold(size) || vertices > kMostItems || triangles > kMostItems) {
      in.fail(fmt::format("{} vertices and {} triangles do not fit the file", vertices, triangles));
    }
    SerializedMesh result;
    TriangleMesh& mesh = result.mesh;
    result.face_normals = flags & kFaceNormals;
    mesh.positions = vectors(in, vertices, flags);
    if (flags & kHasNormals) mesh.normals = vectors(in, vertices, flags);
    if (flags & kHasTexCoords) {
      const std::vector<float> n = numbers(in, 2 * vertices, flags);
      for (std::size_t i = 0; i < n.size(); i += 2) mesh.uvs.push_back({n[i], n[i + 1]});
    }
    if (flags & kHasColors) read_colors(in, vertices, flags, with_colors, mesh);
    if (with_colors && mesh.attributes.empty()) in.fail("has no vertex colours");
    read_triangles(in, triangles, mesh);
    return result;
  }

 private:
  static constexpr std::uint64_t kMostItems = std::numeric_limits<std::int32_t>::max();

  [[noreturn]] void fail(const std::string& what) const { throw Error(path_ + ": " + what); }

  template <typename T>
  T at(std::size_t offset) const {
    if (offset + sizeof(T) > bytes_.size()) fail("the file ends early");
    return from_little_endian<T>(bytes_.data() + offset);
  }

  /// The version of the mesh that begins there.
  std::uint16_t check_header(std::size_t offset) const {
    if (at<std::uint16_t>(offset) != kMagic) {
      fail(offset == 0 ? "no serialized mesh: it does not begin with the bytes 1C 04"
                       : fmt::format("no mesh begins at byte {}", offset));
    }
    const auto version = at<std::uint16_t>(offset + 2);
    if (version != 3 && version != 4) fail(fmt::format("version {}; expected 3 or 4", version));
    return version;
  }

  /// Where mesh `index` begins and ends. The list stands at the end of the file, its length last.
  std::pair<std::size_t, std::size_t> extent(int index, std::uint16_t version) const {
    const std::size_t width = version >= 4 ? 8 : 4;
    if (bytes_.size() < kHeaderSize + 4) fail("the file ends early");
    const std::size_t count = at<std::uint32_t>(bytes_.size() - 4);
    if (count > (bytes_.size() - 4) / width)
      fail("the list of meshes at the end of the file is broken");
    if (index < 0 || static_cast<std::size_t>(index) >= count) {
      fail(fmt::format("the shape index {} is out of range; the file has {} meshes", index, count));
    }
    const std::size_t list = bytes_.size() - 4 - count * width;
    const auto offset = [&](std::size_t i) {
      const std::size_t place = list + i * width;
      return width == 8 ? static_cast<std::size_t>(at<std::uint64_t>(place))
                        : at<std::uint32_t>(place);
    };
    const auto i = static_cast<std::size_t>(index);
    const std::size_t begin = offset(i), end = i + 1 < count ? offset(i + 1) : list;
    if (end > list || begin > end || end - begin < kHeaderSize) {
      fail("the list of meshes at the end of the file is broken");
    }
    return {begin, end};
  }

  static std::vector<float> numbers(Inflater& in, std::uint64_t count, std::uint32_t flags) {
    const std::size_t width = flags & kDoublePrecision ? 8 : 4;
    std::vector<char> raw(count * width);
    in.read(raw.data(), raw.size());
    std::vector<float> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      const char* at = raw.data() + i * width;
      result[i] = width == 8 ? static_cast<float>(from_little_endian<double>(at))
                             : from_little_endian<float>(at);
      if (!std::isfinite(result[i])) in.fail("a number is not finite");
    }
    return result;
  }

  static std::vector<Vec3> vectors(Inflater& in, std::uint64_t count, std::uint32_t flags) {
    const std::vector<float> n = numbers(in, 3 * count, flags);
    std::vector<Vec3> result;
    result.reserve(count);
    for (std::size_t i = 0; i < n.size(); i += 3) result.push_back({n[i], n[i + 1], n[i + 2]});
    return result;
  }

  static void read_colors(Inflater& in, std::uint64_t vertices, std::uint32_t flags, bool wanted,
                          TriangleMesh& mesh) {
    const std::vector<Vec3> colors = vectors(in, vertices, flags);
    if (!wanted) return;
    MeshAttribute& attribute = mesh.attributes.emplace_back();
    attribute.name = "vertex_color";
    for (const Vec3 c : colors) attribute.values.push_back({c.x, c.y, c.z});
  }

  static void read_triangles(Inflater& in, std::uint64_t count, TriangleMesh& mesh) {
    std::vector<char> raw(count * 12);
    in.read(raw.data(), raw.size());
    mesh.triangles.resize(count);
    for (std::size_t i = 0; i < 3 * count; ++i) {
      const auto vertex = from_little_endian<std::uint32_t>(raw.data() + 4 * i);
      if (vertex >= mesh.positions.size()) {
        in.fail(fmt::format("triangle {}: the index {} is out of range; there are {} vertices",
                            i / 3, vertex, mesh.positions.size()));
      }
      mesh.triangles[i / 3][i % 3] = vertex;
    }
    if (count == 0) in.fail("has no triangles");
  }

  const std::string& path_;
  std::string_view bytes_;
};

}  // namespace

SerializedMesh read_serialized(const std::string& path, std::string_view bytes, int index,
                               bool with_colors) {
  return Reader(path, bytes).read(index, with_colors);
}

}  // namespace octolux
