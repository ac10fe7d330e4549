// Which pixels count: those of a mask picture, of a rectangle, or both.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/compare/layer_view.h"

namespace octolux {

/// One byte per pixel, row-major: 1 counts, 0 does not. Empty: every pixel counts.
using Mask = std::vector<std::uint8_t>;

struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;  // pixels; y from the top
};

/// "X,Y,WIDTHxHEIGHT". Throws Error naming `source`.
Rectangle parse_rectangle(const std::string& source, const std::string& text);

/// Pixels of `picture` where any channel of the root layer is above 0. Throws Error if it is not of
/// the reference's size.
Mask mask_of(const NamedPicture& picture, const LayerView& reference);

/// The pixels inside. Throws Error naming `source` unless the rectangle lies inside the picture.
Mask mask_of(const std::string& source, const Rectangle& rectangle, const LayerView& reference);

/// The pixels that count in both.
Mask intersection(const Mask& a, const Mask& b);

/// Of `pixels` pixels.
std::int64_t count_pixels(const Mask& mask, std::size_t pixels);

inline bool counts(const Mask& mask, std::size_t pixel) { return mask.empty() || mask[pixel] != 0; }

}  // namespace octolux
