// Words on pictures: stb_easy_font's letters, drawn as whole pixels. ASCII only; other bytes become
// '?'. Thread-safe.
#pragma once

#include <string>

#include "core/image.h"

namespace octolux {

/// Width [pixels] of one line at a whole-number scale.
int text_width(const std::string& line, int scale);
/// Height [pixels] from one line to the next.
constexpr int line_height(int scale) { return 12 * scale; }

/// Draws one line with its upper left corner at (x, y); what lies outside is cut off.
struct TextStyle {
  int scale = 1;
  Rgb colour{0, 0, 0};
};
void draw_text(Image& image, int x, int y, const std::string& line, const TextStyle& style);

/// The end of `line`, after "...", that is at most `width` pixels wide; the whole line if it fits.
std::string fit_text(const std::string& line, int width, int scale);

}  // namespace octolux
