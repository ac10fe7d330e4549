// Pixels in memory. Row 0 is the top row.
#pragma once

#include <vector>

#include "core/rgb.h"

namespace octolux {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;  // row-major, width * height

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h) {}

  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

}  // namespace octolux
