// text.h over stb_easy_font, which makes letters of axis-aligned quads in units of one pixel.
#include "tools/compare/text.h"

#include <stb_easy_font.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace octolux {
namespace {

/// stb_easy_font's vertex.
struct Vertex {
  float x, y, z;
  unsigned char colour[4];
};
static_assert(sizeof(Vertex) == 16);

std::string ascii(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

int scaled(float v, int scale) { return static_cast<int>(std::lround(v)) * scale; }

}  // namespace

int text_width(const std::string& line, int scale) {
  std::string text = ascii(line);
  return stb_easy_font_width(text.data()) * scale;
}

void draw_text(Image& image, int x, int y, const std::string& line, const TextStyle& style) {
  std::string text = ascii(line);
  constexpr std::size_t kVerticesPerLetter = 4 * 24;  // no letter has more quads
  std::vector<Vertex> vertices(kVerticesPerLetter * (text.size() + 1));
  const int quads = stb_easy_font_print(0, 0, text.data(), nullptr, vertices.data(),
                                        static_cast<int>(vertices.size() * sizeof(Vertex)));
  for (int q = 0; q < quads; ++q) {
    const Vertex& low = vertices[4 * static_cast<std::size_t>(q)];
    const Vertex& high = vertices[4 * static_cast<std::size_t>(q) + 2];
    const int left = std::max(0, x + scaled(low.x, style.scale));
    const int right = std::min(image.width, x + scaled(high.x, style.scale));
    const int bottom = std::min(image.height, y + scaled(high.y, style.scale));
    for (int row = std::max(0, y + scaled(low.y, style.scale)); row < bottom; ++row) {
      for (int column = left; column < right; ++column) image.at(column, row) = style.colour;
    }
  }
}

std::string fit_text(const std::string& line, int width, int scale) {
  if (text_width(line, scale) <= width) return line;
  std::string rest = line;
  while (!rest.empty() && text_width("..." + rest, scale) > width) rest.erase(0, 1);
  return "..." + rest;
}

}  // namespace octolux
