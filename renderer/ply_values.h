// The numbers in the body of a PLY file, one after the other, from text or bytes of either order.
// Each source has the same two functions; the reader (ply_file.cpp) is a template over them.
#pragma once

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "renderer/ply_header.h"

namespace octolux {

/// Numbers in text. Not thread-safe.
class PlyText {
 public:
  explicit PlyText(std::string_view body)
      : begin_(body.data()), at_(begin_), end_(begin_ + body.size()) {}

  /// Empty at the end of the file, and where there is no number.
  std::optional<double> next(PlyType) {
    skip_blanks();
    if (at_ != end_ && *at_ == '+') ++at_;
    double value = 0;
    const auto [stop, error] = std::from_chars(at_, end_, value);
    if (error != std::errc() || (stop != end_ && !is_blank(*stop))) return std::nullopt;
    at_ = stop;
    return value;
  }
  bool at_end() {
    skip_blanks();
    return at_ == end_;
  }
  std::size_t position() const { return static_cast<std::size_t>(at_ - begin_); }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }

  const char* begin_;
  const char* at_;
  const char* end_;
};

/// Numbers as bytes; `swapped` if their order is not this machine's. Not thread-safe.
template <bool swapped>
class PlyBytes {
 public:
  explicit PlyBytes(std::string_view body) : body_(body) {}

  /// Empty at the end of the file.
  std::optional<double> next(PlyType type) {
    if (body_.size() - at_ < size_of(type)) return std::nullopt;
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return take<float>();
      case PlyType::float64:
        return take<double>();
    }
    return std::nullopt;
  }
  bool at_end() const { return at_ == body_.size(); }
  std::size_t position() const { return at_; }

 private:
  template <typename T>
  double take() {
    char bytes[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes[i] = body_[at_ + (swapped ? sizeof(T) - 1 - i : i)];
    }
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
  }

  std::string_view body_;
  std::size_t at_ = 0;
};

}  // namespace octolux
