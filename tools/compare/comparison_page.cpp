// comparison_page.h.
#include "tools/compare/comparison_page.h"

#include <fmt/format.h>

#include <algorithm>

namespace octolux {
namespace {

PageMap heat_map(const std::string& name, ScalarField field, double range) {
  PageMap map{"difference of " + name, std::move(field), true, -range, range, " %", 0.01, ""};
  map.caption = "(x - y) / sqrt(y^2 + 0.01) of luminance: blue x is darker, orange x is brighter";
  return map;
}

PageMap flip_map(const std::string& name, const FlipMap& flip) {
  PageMap map{"HDR-FLIP of " + name, {flip.width, flip.height, flip.error}, false, 0, 1, "", 1, ""};
  map.caption = "HDR-FLIP: 0 no difference seen, 1 the largest";
  return map;
}

std::vector<std::string> notes_of(const Comparison& c, const LayerView& reference) {
  std::vector<std::string> notes = {
      fmt::format("x is an image, y the reference {}; {}, {}x{} pixels", c.reference,
                  layer_title(reference.layer), c.width, c.height)};
  if (!c.mask.empty()) notes.push_back(fmt::format("{} pixels count: {}", c.mask_pixels, c.mask));
  return notes;
}

}  // namespace

PageTable figure_table(const Comparison& c) {
  PageTable table;
  for (const ImageComparison& image : c.images) table.rows.push_back({image.image, {}});
  for (const Figure& figure : figures()) {
    const bool known = std::any_of(c.images.begin(), c.images.end(), [&](const auto& image) {
      return figure.value(image.layers.front()).has_value();
    });
    if (!known) continue;
    table.columns.push_back({figure.title, figure.formula, figure.better});
    for (std::size_t i = 0; i < c.images.size(); ++i) {
      table.rows[i].pointers.push_back(
          fmt::format("/images/{}/layers/0/figures/{}", i, figure.key));
    }
  }
  return table;
}

Page comparison_page(const Comparison& c, const ComparedViews& views, const DisplayOptions& display,
                     double range, const std::string& json) {
  Page page;
  page.title = "Octolux compare: " + c.reference;
  page.notes = notes_of(c, views.reference);
  page.display = display;
  page.data = json;
  page.table = figure_table(c);
  const bool coloured = views.reference.channels.front() == "R";
  if (coloured) page.pictures.push_back({c.reference + " (y)", image_of(views.reference)});
  for (std::size_t i = 0; i < views.images.size(); ++i) {
    const std::string& name = c.images[i].image;
    if (coloured) page.pictures.push_back({name, image_of(views.images[i])});
    page.maps.push_back(
        heat_map(name, relative_difference(views.reference, views.images[i]), range));
    const auto& flip = c.images[i].layers.front().flip;
    if (flip) page.maps.push_back(flip_map(name, flip->map));
  }
  return page;
}

}  // namespace octolux
