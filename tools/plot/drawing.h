// A drawing of lines, filled shapes and words, made once and written as SVG or as pixels, so that
// both show the same plot. Lengths are in points of the page (SVG's pixels), y downward. What comes
// later lies on top.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/image.h"

namespace octolux {

/// "#rrggbb" in SVG; as numbers for pixels.
struct Ink {
  int r = 0, g = 0, b = 0;  // sRGB, [0, 255]
};

struct Spot {
  double x = 0, y = 0;
};

struct Polyline {
  std::vector<Spot> points;
  Ink ink;
  double width = 1;
  std::vector<double> dashes = {};  // on, off, ...; empty: solid
};

/// A filled convex polygon.
struct Polygon {
  std::vector<Spot> points;  // in order, either way round
  Ink ink;
};

struct Words {
  Spot at;                // of the base line
  std::string text = {};  // what follows "^" is raised, unless the words are turned
  enum class Anchor { start, middle, end } anchor = Anchor::start;
  bool upward = false;  // turned by a quarter, reading up the page
  bool bold = false;
  Ink ink = {};
};

/// Height of an em of Words.
inline constexpr double kEm = 12;
/// By how much an exponent stands higher.
inline constexpr double kRaise = 4;

struct Drawing {
  double width = 0, height = 0;
  std::vector<std::variant<Polyline, Polygon, Words>> items;
};

std::string to_svg(const Drawing& drawing);

/// `scale` pixels a point, on white, display values in [0, 1].
Image to_pixels(const Drawing& drawing, int scale);

/// The characters &, <, > and " as HTML and SVG want them.
std::string escape_markup(const std::string& text);

}  // namespace octolux
