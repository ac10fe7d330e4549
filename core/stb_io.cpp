// PNG files and textures through stb_image and stb_image_write (image_io.h), as Debian's libstb.
// The sole user of those two. EXR textures go to our own reader (exr_io.cpp).
//
// stb_image takes a file that ends early for one that goes on with zeros, or leaves pixels unset.
// So it reads through callbacks that notice when it asks for more than there is. Thread-safe: stb
// keeps its failure reasons per thread, and none of its global settings is touched.
#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "core/check.h"
#include "core/error.h"
#include "core/file_io.h"
#include "core/image_io.h"

namespace octolux {
namespace {

/// More pixels than this are a broken header, not a picture.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

/// sRGB's curve, from display value to linear light (IEC 61966-2-1).
float srgb_to_linear(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

void to_linear(Image& image) {
  for (Rgb& c : image.pixels) {
    c = {srgb_to_linear(c.r), srgb_to_linear(c.g), srgb_to_linear(c.b)};
  }
}

std::uint8_t to_byte(float v) {
  if (!(v > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::lround(std::min(v, 1.0f) * 255));
}

[[noreturn]] void fail_to_read(const std::string& path, const std::string& why) {
  throw Error(path +
              ": cannot be read as a picture; expected PNG, JPEG, TGA, BMP, HDR or EXR: " + why);
}

/// A file in memory as stb_image reads it.
class Source {
 public:
  /// `endless`: what follows the file's end is line breaks, not nothing.
  Source(std::span<const char> bytes, bool endless) : rest_(bytes), endless_(endless) {}

  static stbi_io_callbacks callbacks() { return {read, skip, at_end}; }
  /// Was more asked for than there is?
  bool cut_short() const { return cut_short_; }

 private:
  /// stb_image asks for pixels, or fills a buffer of its own, the same at every call and the first
  /// to be asked for. Only the buffer may be filled in part.
  static int read(void* user, char* data, int size) {
    Source& source = *static_cast<Source*>(user);
    if (!source.buffer_) source.buffer_ = data;
    const auto wanted = static_cast<std::size_t>(size);
    const std::size_t count = std::min(wanted, source.rest_.size());
    std::copy_n(source.rest_.begin(), count, data);
    std::fill_n(data + count, wanted - count, '\n');
    source.rest_ = source.rest_.subspan(count);
    if (count == 0 || (count < wanted && data != source.buffer_)) source.cut_short_ = true;
    return source.endless_ ? size : static_cast<int>(count);
  }

  static void skip(void* user, int size) {
    Source& source = *static_cast<Source*>(user);
    const auto count = static_cast<std::size_t>(std::max(size, 0));
    source.rest_ = source.rest_.subspan(std::min(count, source.rest_.size()));
  }

  static int at_end(void* user) { return static_cast<Source*>(user)->rest_.empty(); }

  std::span<const char> rest_;
  bool endless_;
  const char* buffer_ = nullptr;
  bool cut_short_ = false;
};

/// A whole file, of at most INT_MAX bytes.
struct Encoded {
  const std::string& path;
  const std::string& bytes;

  const stbi_uc* data() const { return reinterpret_cast<const stbi_uc*>(bytes.data()); }
  int size() const { return static_cast<int>(bytes.size()); }
  /// Radiance's format: linear light in floating point.
  bool is_hdr() const { return stbi_is_hdr_from_memory(data(), size()); }
  bool is_16_bit() const { return stbi_is_16_bit_from_memory(data(), size()); }
  bool is_exr() const { return bytes.starts_with("\x76\x2f\x31\x01"); }
};

void check_size(const Encoded& file) {
  int width = 0, height = 0, channels = 0;
  // If not even this can be read, decoding will say why.
  if (!stbi_info_from_memory(file.data(), file.size(), &width, &height, &channels)) return;
  if (width >= 1 && height >= 1 && width <= kMaxPixels / height) return;
  fail_to_read(file.path, "its header says " + std::to_string(width) + "x" +
                              std::to_string(height) +
                              " pixels, not at least 1x1 and at most 2^28");
}

/// The numbers of the file over `one`, through stb_image's function `load` for its type of number.
template <class Number>
Image decode_numbers(const Encoded& file, float one,
                     Number* (*load)(const stbi_io_callbacks*, void*, int*, int*, int*, int)) {
  constexpr int kRgb = 3;  // stb_image spreads grey and drops alpha
  const stbi_io_callbacks callbacks = Source::callbacks();
  // Behind the end stb_image reads zeros, and runs of no pixels would keep its HDR reader for ever.
  // Line breaks end its header, and are runs of ten.
  Source source(file.bytes, file.is_hdr());
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<Number, void (*)(void*)> numbers(
      load(&callbacks, &source, &width, &height, &channels, kRgb), stbi_image_free);
  if (numbers && source.cut_short()) fail_to_read(file.path, "it ends too early");
  if (!numbers) fail_to_read(file.path, stbi_failure_reason());
  Image image(width, height);
  const Number* n = numbers.get();
  for (Rgb& c : image.pixels) {
    const auto channel = [&](int i) { return static_cast<float>(n[i]) / one; };
    c = {channel(0), channel(1), channel(2)};
    n += kRgb;
  }
  return image;
}

Image decode(const Encoded& file) {
  if (file.is_hdr()) return decode_numbers(file, 1, stbi_loadf_from_callbacks);
  if (file.is_16_bit()) return decode_numbers(file, 65535, stbi_load_16_from_callbacks);
  return decode_numbers(file, 255, stbi_load_from_callbacks);
}

Image decode_exr(const std::string& path) {
  const ExrFile file = read_exr(path);
  try {
    return file.image();
  } catch (const Error& e) {
    throw Error(path + ": " + e.what());
  }
}

}  // namespace

void write_png(const std::string& path, const Image& image) {
  OCTOLUX_CHECK(image.width > 0 && image.height > 0);
  constexpr int kRgb = 3;
  // stb_image_write counts bytes in int.
  if (image.pixels.size() * kRgb + image.pixels.size() > std::numeric_limits<int>::max()) {
    throw Error(path + ": cannot be encoded as PNG; expected less than 2^29 pixels");
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * kRgb);
  for (const Rgb& p : image.pixels) {
    for (int c = 0; c < kRgb; ++c) bytes.push_back(to_byte(p[c]));
  }
  std::string file;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                          static_cast<std::size_t>(size));
  };
  if (!stbi_write_png_to_func(append, &file, image.width, image.height, kRgb, bytes.data(),
                              image.width * kRgb)) {
    throw Error(path + ": cannot be encoded as PNG: out of memory");
  }
  write_file(path, file);
}

Image read_image(const std::string& path, Encoding encoding) {
  const std::string bytes = read_file(path);
  const Encoded file{path, bytes};
  if (file.is_exr()) {
    Image image = decode_exr(path);
    if (encoding == Encoding::srgb) to_linear(image);
    return image;
  }
  if (bytes.size() > std::numeric_limits<int>::max()) {
    fail_to_read(path, "it has more than 2^31 - 1 bytes");
  }
  check_size(file);
  Image image = decode(file);
  const bool is_linear =
      encoding == Encoding::linear || (encoding == Encoding::automatic && file.is_hdr());
  if (!is_linear) to_linear(image);
  return image;
}

}  // namespace octolux
