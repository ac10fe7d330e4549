// drawing.h as SVG 1.1.
#include <fmt/format.h>

#include "tools/plot/drawing.h"

namespace octolux {
namespace {

std::string colour(Ink ink) { return fmt::format("#{:02x}{:02x}{:02x}", ink.r, ink.g, ink.b); }

std::string path_data(const std::vector<Spot>& points, bool closed) {
  std::string data;
  for (const Spot& p : points) {
    data += fmt::format("{}{:.1f} {:.1f}", data.empty() ? "M" : "L", p.x, p.y);
  }
  return closed ? data + "z" : data;
}

/// What stands behind "^", as drawing.h says.
std::string raise_exponent(const std::string& text) {
  const auto mark = text.find('^');
  if (mark == std::string::npos) return text;
  return fmt::format("{}<tspan dy=\"{:g}\" font-size=\"75%\">{}</tspan>", text.substr(0, mark),
                     -kRaise, text.substr(mark + 1));
}

struct ToSvg {
  std::string operator()(const Polyline& line) const {
    std::string dashes;
    for (const double d : line.dashes) {
      dashes += fmt::format("{}{:g}", dashes.empty() ? " stroke-dasharray=\"" : " ", d);
    }
    if (!dashes.empty()) dashes += "\"";
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" "
        "stroke-linejoin=\"round\"{}/>\n",
        path_data(line.points, false), colour(line.ink), line.width, dashes);
  }
  std::string operator()(const Polygon& polygon) const {
    return fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", path_data(polygon.points, true),
                       colour(polygon.ink));
  }
  std::string operator()(const Words& words) const {
    constexpr const char* kAnchors[] = {"start", "middle", "end"};
    const std::string place =
        words.upward ? fmt::format("transform=\"translate({:.1f} {:.1f}) rotate(-90)\"", words.at.x,
                                   words.at.y)
                     : fmt::format("x=\"{:.1f}\" y=\"{:.1f}\"", words.at.x, words.at.y);
    return fmt::format("<text {} text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n", place,
                       kAnchors[static_cast<int>(words.anchor)], colour(words.ink),
                       words.bold ? " font-weight=\"bold\"" : "",
                       raise_exponent(escape_markup(words.text)));
  }
};

}  // namespace

std::string escape_markup(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string to_svg(const Drawing& drawing) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"{2:g}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      drawing.width, drawing.height, kEm);
  for (const auto& item : drawing.items) svg += std::visit(ToSvg{}, item);
  return svg + "</svg>\n";
}

}  // namespace octolux
