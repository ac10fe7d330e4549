// pictures.h.
#include "tools/ab/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/ab/report.h"
#include "tools/compare/sheet.h"

namespace octolux {
namespace {

/// Panels are shrunk to this many pixels.
constexpr double kPanelPixels = 1920.0 * 1200;

constexpr double kPercent = 0.01;
constexpr char kLeakCaption[] =
    "(x - y) / mean y of luminance: orange, x is brighter (light leak); blue, darker (shadow leak)";

int factor_of(const AbResult& r) { return shrink_factor(r.width(), r.height(), kPanelPixels); }

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.2f} %", 100 * share) : "-";
}

/// The figures under a picture.
std::vector<std::string> remarks(const AbResult& r, const AbPicture& p) {
  std::vector<std::string> lines = {fmt::format("{} passes, {:.1f} s, relMSE {:.3g}",
                                                p.progress.passes, p.progress.seconds,
                                                p.masks.front().comparison.metrics.rel_mse)};
  for (std::size_t m = 0; m < r.masks.size(); ++m) {
    const LeakFigures& leaks = p.masks[m].leaks;
    std::string line = fmt::format("{}: light leak {}", r.masks[m].title, percent(leaks.light));
    if (r.masks[m].key != "sealed") line += ", shadow leak " + percent(leaks.shadow);
    lines.push_back(line);
  }
  return lines;
}

std::string title_of(const AbResult& r, const std::string& what) {
  const int factor = factor_of(r);
  std::string text = fmt::format("{}, {}x{} pixels", r.scene, r.width(), r.height());
  if (factor > 1) text += fmt::format(", shown at 1/{}", factor);
  return text + ", " + what;
}

Image linear_of(const NamedPicture& picture) { return image_of(view_layer(picture)); }

Image shown(const NamedPicture& picture, int factor, const DisplayOptions& display) {
  const Image linear = linear_of(picture);
  return to_display(factor > 1 ? shrink(linear, factor) : linear, display);
}

ScalarField leaks_of(const AbResult& r, const AbPicture& p) {
  return leak_field(view_layer(r.reference), view_layer(p.picture));
}

/// Where the masks are: 1 open, 2 near walls, 3 sealed, 0 nothing of these.
ScalarField mask_field(const AbResult& r) {
  ScalarField field{r.width(), r.height(), {}};
  field.values.resize(r.seen.surface.size());
  for (const NamedMask& m : r.masks) {
    const float value = m.key == "open" ? 1.f : m.key == "walls" ? 2.f : 3.f;
    if (m.mask.empty()) continue;
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      if (m.mask[i] != 0) field.values[i] = value;
    }
  }
  return field;
}

void add_columns(PageTable& table, const AbResult& r) {
  const auto add = [&](const std::string& title, const char* formula, const std::string& key,
                       Better better) {
    table.columns.push_back({title, formula, better});
    for (std::size_t i = 0; i < r.pictures.size(); ++i) {
      table.rows[i].pointers.push_back(fmt::format("/renders/{}/{}", i, key));
    }
  };
  add("passes", "passes of photons and eye paths", "passes", Better::neither);
  add("time [s]", "seconds spent rendering", "seconds", Better::smaller);
  for (const Figure& f : figures()) {
    const std::string key = f.key;
    if (key != "relmse" && key != "relmse-trimmed" && key != "bias2") continue;
    add(f.title, f.formula, "masks/image/figures/" + key, f.better);
  }
  for (const NamedMask& m : r.masks) {
    const std::string at = "masks/" + m.key + "/";
    add("light leak, " + m.title, kLightLeakFormula, at + "light-leak", Better::smaller);
    add("shadow leak, " + m.title, kShadowLeakFormula, at + "shadow-leak", Better::smaller);
    add("noise, " + m.title, kNoiseFormula, at + "noise", Better::neither);
  }
}

}  // namespace

double leak_range(const AbResult& r) {
  std::vector<double> ranges;
  for (const AbPicture& p : r.pictures) {
    const ScalarField field = leaks_of(r, p);
    ranges.push_back(heat_map_range({&field, 1}));
  }
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  return *middle;
}

Image ab_sheet(const AbResult& r, const DisplayOptions& display) {
  const int factor = factor_of(r);
  const DisplayOptions names = resolved(display);
  std::vector<Panel> panels = {{"reference", shown(r.reference, factor, display), {}}};
  for (const AbPicture& p : r.pictures) {
    panels.push_back({p.render.name, shown(p.picture, factor, display), remarks(r, p)});
  }
  const std::string view = fmt::format("display {}, view {}, exposure {:+g} stops", names.display,
                                       names.view, names.exposure);
  return make_sheet(title_of(r, view), panels, {}, SheetShape::square);
}

Image leak_sheet(const AbResult& r, double range) {
  const int factor = factor_of(r);
  const ScaleBar scale{ColourMap::diverging(), -range, range, " %", kPercent, kLeakCaption};
  std::vector<Panel> panels;
  for (const AbPicture& p : r.pictures) {
    ScalarField field = leaks_of(r, p);
    if (factor > 1) field = shrink(field, factor);
    panels.push_back({p.render.name, colour_field(field, scale.map, -range, range), remarks(r, p)});
  }
  return make_sheet(title_of(r, "leaks: difference x - y from the reference"), panels, scale,
                    SheetShape::square);
}

Page ab_page(const AbResult& r, const DisplayOptions& display, double range,
             const std::string& json) {
  Page page;
  page.title = "Octolux A/B: " + r.scene;
  page.notes = explanations(r);
  page.display = display;
  page.data = json;
  page.pictures.push_back({"reference (y)", linear_of(r.reference)});
  for (const AbPicture& p : r.pictures) {
    page.pictures.push_back({p.render.name, linear_of(p.picture)});
    page.maps.push_back({"leaks of " + p.render.name, leaks_of(r, p), true, -range, range, " %",
                         kPercent, kLeakCaption});
    page.table.rows.push_back({p.render.name, {}});
  }
  page.maps.push_back({"masks", mask_field(r), false, 0, 3, "", 1,
                       "masks: 1 in the open, 2 near walls or edges, 3 sealed, 0 none of these"});
  add_columns(page.table, r);
  return page;
}

}  // namespace octolux
