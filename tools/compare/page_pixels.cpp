// Pixels of a page (page.h): compact, and unpacked by any browser's own zlib.
#include <half.h>
#include <zlib.h>

#include <cstdint>

#include "core/check.h"
#include "tools/compare/page.h"

namespace octolux {
namespace {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()),
                             static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  OCTOLUX_CHECK(code == Z_OK);
  packed.resize(size);
  return packed;
}

}  // namespace

std::string encode_planes(const std::vector<std::vector<float>>& planes, int width) {
  std::string low, high;
  for (const std::vector<float>& plane : planes) {
    std::uint16_t left = 0;
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const std::uint16_t bits = imath_float_to_half(plane[i]);
      const bool first = i % static_cast<std::size_t>(width) == 0;
      const auto difference = static_cast<std::uint16_t>(first ? bits : bits - left);
      low.push_back(static_cast<char>(difference & 0xff));
      high.push_back(static_cast<char>(difference >> 8));
      left = bits;
    }
  }
  return base64(deflated(low + high));
}

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text.push_back(i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63]);
    }
  }
  return text;
}

}  // namespace octolux
