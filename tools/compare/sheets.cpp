// sheets.h.
#include "tools/compare/sheets.h"

#include <fmt/format.h>

#include "core/error.h"
#include "tools/compare/sheet.h"

namespace octolux {
namespace {

/// Panels are shrunk to this many pixels.
constexpr double kPanelPixels = 1920.0 * 1200;

constexpr double kPercent = 0.01;

int factor_of(const Comparison& c) { return shrink_factor(c.width, c.height, kPanelPixels); }

std::string sizes(const Comparison& c) {
  const int factor = factor_of(c);
  std::string text = fmt::format("{}x{} pixels", c.width, c.height);
  if (factor > 1) text += fmt::format(", shown at 1/{}", factor);
  return c.mask.empty() ? text : text + "; figures over " + c.mask;
}

std::vector<std::string> main_figures(const LayerComparison& l) {
  const Metrics& m = l.metrics;
  std::vector<std::string> lines = {
      fmt::format("relMSE {:.3g}, trimmed {:.3g}", m.rel_mse, m.trimmed_rel_mse),
      fmt::format("light leak {:.2f} %, shadow leak {:.2f} %", 100 * m.light_leak,
                  100 * m.shadow_leak),
      fmt::format("mean x / mean y = {:.4f}", m.mean_ratio)};
  if (l.flip)
    lines.push_back(fmt::format("HDR-FLIP {:.3f}, LDR-FLIP {:.3f}", l.flip->hdr, l.flip->ldr));
  const std::int64_t bad = m.image.non_finite() + m.reference.non_finite();
  if (bad > 0) lines.push_back(fmt::format("{} pixels not finite (magenta in heat maps)", bad));
  return lines;
}

Image shown(const LayerView& view, int factor, const DisplayOptions& display) {
  const Image linear = image_of(view);
  return to_display(factor > 1 ? shrink(linear, factor) : linear, display);
}

std::string view_title(const DisplayOptions& display) {
  const DisplayOptions names = resolved(display);
  return fmt::format("display {}, view {}, exposure {:+g} stops", names.display, names.view,
                     names.exposure);
}

}  // namespace

std::vector<ScalarField> relative_differences(const ComparedViews& views) {
  std::vector<ScalarField> fields;
  for (const LayerView& image : views.images) {
    fields.push_back(relative_difference(views.reference, image));
  }
  return fields;
}

Image side_by_side_sheet(const Comparison& c, const ComparedViews& views,
                         const DisplayOptions& display) {
  if (views.reference.channels.front() != "R") {
    throw Error(fmt::format("{}: {} cannot be shown; expected channels R, G and B", c.reference,
                            layer_title(views.reference.layer)));
  }
  const int factor = factor_of(c);
  std::vector<Panel> panels;
  panels.push_back({"reference: " + c.reference, shown(views.reference, factor, display), {}});
  for (std::size_t i = 0; i < views.images.size(); ++i) {
    panels.push_back({c.images[i].image, shown(views.images[i], factor, display),
                      main_figures(c.images[i].layers.front())});
  }
  return make_sheet(
      fmt::format("{}, {}, {}", layer_title(views.reference.layer), sizes(c), view_title(display)),
      panels);
}

Image heat_map_sheet(const Comparison& c, const ComparedViews& views, double range) {
  const int factor = factor_of(c);
  ScaleBar scale{ColourMap::diverging(), -range, range, " %", kPercent, ""};
  scale.caption =
      "(x - y) / sqrt(y^2 + 0.01) of luminance, x image, y reference:"
      " blue x is darker (shadow leak), orange x is brighter (light leak)";
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < views.images.size(); ++i) {
    ScalarField field = relative_difference(views.reference, views.images[i]);
    if (factor > 1) field = shrink(field, factor);
    panels.push_back({c.images[i].image, colour_field(field, scale.map, -range, range),
                      main_figures(c.images[i].layers.front())});
  }
  return make_sheet(fmt::format("Relative difference from {}, {}, {}", c.reference,
                                layer_title(views.reference.layer), sizes(c)),
                    panels, scale);
}

}  // namespace octolux
