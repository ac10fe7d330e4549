// Laboratory results as a grid of panels with a shared legend (tools/plot).
#include <algorithm>
#include <cmath>

#include "tools/lab/report.h"
#include "tools/plot/axes.h"

namespace octolux {
namespace {

constexpr double kPanelWidth = 360, kPanelHeight = 240, kLeft = 56, kTop = 34, kGap = 40;
constexpr double kRight = 24, kKeyWidth = 200;
constexpr int kColumns = 2, kKeys = 4;

struct Series {
  std::string kernel;
  std::vector<const LabResult*> points;
};

std::vector<Series> series_of(const LabTable& table) {
  std::vector<Series> all;
  for (const LabResult& r : table.results) {
    auto series =
        std::find_if(all.begin(), all.end(), [&](const Series& s) { return s.kernel == r.kernel; });
    if (series == all.end()) series = all.insert(all.end(), Series{r.kernel, {}});
    series->points.push_back(&r);
  }
  return all;
}

double abscissa(const LabResult& r, PlotAxis axis) {
  return axis == PlotAxis::angle ? r.angle : r.neighbours;
}

/// From the results, at least +-5 % and at most +-100 %.
std::pair<double, double> bias_range(const LabTable& table) {
  double low = -0.05, high = 0.05;
  for (const LabResult& r : table.results) {
    low = std::min(low, r.bias() - 0.02), high = std::max(high, r.bias() + 0.02);
  }
  return {std::max(low, -1.0), std::min(high, 1.0)};
}

PlotPanel make_panel(const LabTable& table, PlotAxis axis, Spot corner) {
  double low = kInfinity, high = -kInfinity;
  for (const LabResult& r : table.results) {
    low = std::min(low, abscissa(r, axis)), high = std::max(high, abscissa(r, axis));
  }
  if (!(high > low)) high = low + 1;
  const auto [floor, ceiling] = bias_range(table);
  PlotPanel panel;
  panel.x = {low, high, corner.x, corner.x + kPanelWidth, axis == PlotAxis::neighbours};
  panel.y = {floor, ceiling, corner.y + kPanelHeight, corner.y};
  panel.title = table.title;
  panel.x_title =
      axis == PlotAxis::angle ? "angle of the wall [degrees]" : "photons in the look-up";
  panel.y_title = "bias [%]";
  panel.y_unit = 0.01;
  return panel;
}

void draw_series(Drawing& drawing, const PlotPanel& panel, const Series& series, PlotAxis axis,
                 std::size_t i) {
  std::vector<PlotPoint> points;
  for (const LabResult* r : series.points) {
    const double bar = 2 * r->standard_error;
    points.push_back({abscissa(*r, axis), r->bias(), r->bias() - bar, r->bias() + bar});
  }
  draw_curve(drawing, panel, points, i);
}

}  // namespace

std::string to_svg(const std::vector<LabTable>& tables, PlotAxis axis) {
  const auto rows = (static_cast<int>(tables.size()) + kColumns - 1) / kColumns;
  const double row_height = kTop + kPanelHeight + kGap;
  const double column_width = kLeft + kPanelWidth + kRight;
  const std::vector<Series> keys = tables.empty() ? std::vector<Series>{} : series_of(tables[0]);
  Drawing drawing;
  drawing.width = kColumns * column_width;
  drawing.height =
      rows * row_height + 20 * std::ceil(static_cast<double>(keys.size()) / kKeys) + 16;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Spot corner{kLeft + static_cast<double>(i % kColumns) * column_width,
                      kTop + static_cast<double>(i / kColumns) * row_height};
    const PlotPanel panel = make_panel(tables[i], axis, corner);
    draw_axes(drawing, panel);
    const std::vector<Series> all = series_of(tables[i]);
    for (std::size_t k = 0; k < all.size(); ++k) draw_series(drawing, panel, all[k], axis, k);
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Spot at{kLeft + kKeyWidth * static_cast<double>(i % kKeys),
                  rows * row_height + 10 + 20 * static_cast<double>(i / kKeys)};
    draw_key(drawing, at, i, keys[i].kernel);
  }
  return to_svg(drawing);
}

}  // namespace octolux
