// page.h: puts everything into the page's template.
#include "tools/compare/page.h"

#include <fmt/format.h>

#include <cmath>

#include "core/check.h"
#include "tools/compare/page_assets.h"

namespace octolux {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kProbes = 16;  // per picture

/// JSON text that may stand in a <script>: no tag can end or open in it.
std::string embeddable(std::string json) {
  std::string text;
  for (const char c : json) text += c == '<' ? "\\u003c" : std::string(1, c);
  return text;
}

std::string filled(std::string text, const std::string& mark, const std::string& content) {
  const auto at = text.find(mark);
  OCTOLUX_CHECK(at != std::string::npos);
  return text.replace(at, mark.size(), content);
}

std::vector<std::vector<float>> planes_of(const Image& image) {
  return rgb_layer("", image).planes;
}

/// Adds values by which the page's self-test knows that it unpacked a picture rightly.
void add_probes(Json& probes, std::size_t picture, const std::vector<std::vector<float>>& planes) {
  const std::size_t pixels = planes.front().size();
  for (int i = 0; i < kProbes; ++i) {
    const std::size_t pixel = (pixels - 1) * static_cast<std::size_t>(i) / (kProbes - 1);
    const std::size_t channel = static_cast<std::size_t>(i) % planes.size();
    const float v = planes[channel][pixel];
    constexpr float kLargestHalf = 65504;
    Json value;  // null: not finite, as a half
    if (std::abs(v) <= kLargestHalf) value = v;
    probes.push_back({picture, pixel, channel, value});
  }
}

/// Colours by which the self-test knows that it shows a picture as OpenColorIO does.
void add_shown(Json& probes, std::size_t picture, const Image& shown) {
  const std::size_t pixels = shown.pixels.size();
  for (int i = 0; i < kProbes; ++i) {
    const std::size_t pixel = (pixels - 1) * static_cast<std::size_t>(i) / (kProbes - 1);
    const Rgb c = shown.pixels[pixel];
    probes.push_back({picture, pixel, 255 * c.r, 255 * c.g, 255 * c.b});
  }
}

Json describe(const PageTable& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const PageTable::Column& c : table.columns) {
    const char* better = c.better == Better::smaller  ? "smaller"
                         : c.better == Better::larger ? "larger"
                                                      : "neither";
    columns.push_back({{"title", c.title}, {"formula", c.formula}, {"better", better}});
  }
  for (const PageTable::Row& row : table.rows) {
    rows.push_back({{"name", row.name}, {"pointers", row.pointers}});
  }
  return {{"columns", columns}, {"rows", rows}};
}

Json describe(const PageMap& map, const ScalarField& field) {
  return {{"name", map.name},       {"map", map.diverging ? "diverging" : "sequential"},
          {"low", map.low},         {"high", map.high},
          {"unit", map.unit},       {"unit_size", map.unit_size},
          {"caption", map.caption}, {"pixels", encode_planes({field.values}, field.width)}};
}

std::string colours_of(const ColourMap& map) {
  std::string bytes;
  for (const Rgb& c : map.colours()) {
    for (int i = 0; i < 3; ++i) bytes.push_back(static_cast<char>(std::lround(255 * c[i])));
  }
  return base64(bytes);
}

/// Pictures and maps, at a size a browser can hold.
void add_pictures(Json& json, const Page& page, int factor) {
  json["pictures"] = json["probes"] = json["shown"] = Json::array();
  for (const PagePicture& picture : page.pictures) {
    const Image image = factor > 1 ? shrink(picture.linear, factor) : picture.linear;
    OCTOLUX_CHECK(image.width == json["width"] && image.height == json["height"]);
    const auto planes = planes_of(image);
    add_probes(json["probes"], json["pictures"].size(), planes);
    add_shown(json["shown"], json["pictures"].size(), to_display(image, page.display));
    json["pictures"].push_back(
        {{"name", picture.name}, {"pixels", encode_planes(planes, image.width)}});
  }
  for (const PageMap& map : page.maps) {
    const ScalarField field = factor > 1 ? shrink(map.field, factor) : map.field;
    OCTOLUX_CHECK(field.width == json["width"] && field.height == json["height"]);
    add_probes(json["probes"], json["pictures"].size(), {field.values});
    json["pictures"].push_back(describe(map, field));
  }
}

}  // namespace

std::string make_page(const Page& page) {
  OCTOLUX_CHECK(!page.pictures.empty() || !page.maps.empty());
  const int width =
      page.pictures.empty() ? page.maps[0].field.width : page.pictures[0].linear.width;
  const int height =
      page.pictures.empty() ? page.maps[0].field.height : page.pictures[0].linear.height;
  const int factor = shrink_factor(width, height, kPagePixels);
  Json json = {{"title", page.title},
               {"notes", page.notes},
               {"width", (width + factor - 1) / factor},
               {"height", (height + factor - 1) / factor},
               {"shrink", factor},
               {"exposure", page.display.exposure},
               {"view", view_table(page.display)},
               {"maps",
                {{"diverging", colours_of(ColourMap::diverging())},
                 {"sequential", colours_of(ColourMap::sequential())}}},
               {"table", describe(page.table)}};
  json["notes"].push_back(fmt::format("view {}; pixel values are half floats (11 bits)",
                                      json["view"]["name"].get<std::string>()));
  if (factor > 1) {
    json["notes"].push_back(fmt::format("{}x{} pixels, shown at 1/{}", width, height, factor));
  }
  add_pictures(json, page, factor);
  std::string html = filled(page_assets::kHtml, "/*STYLE*/", page_assets::kStyle);
  html = filled(html, "/*SCRIPT*/", page_assets::kScript);
  html = filled(html, "/*SELFTEST*/", page_assets::kSelftest);
  html = filled(html, "/*PAGE*/", embeddable(json.dump()));
  return filled(html, "/*DATA*/", embeddable(page.data));
}

}  // namespace octolux
