// Plots as SVG, written by hand: a grid of panels with a shared legend.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/lab/report.h"

namespace octolux {
namespace {

constexpr double kPanelWidth = 360, kPanelHeight = 240, kLeft = 56, kTop = 34, kGap = 40;
constexpr int kColumns = 2;
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000", "#999933"};

/// From data to the panel's pixels.
struct Scale {
  double low, high, from, to;
  double operator()(double v) const { return from + (to - from) * (v - low) / (high - low); }
};

struct Series {
  std::string kernel;
  std::vector<const LabResult*> points;
};

struct Panel {
  Scale x, y;
  PlotAxis axis;
  double place(const LabResult& r) const {
    return x(axis == PlotAxis::angle ? r.angle : std::log10(r.neighbours));
  }
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

/// A step of 1, 2 or 5 times a power of ten that cuts `range` into about five.
double tick_step(double range) {
  const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (rough <= step * power) return step * power;
  }
  return 10 * power;
}

/// [%] from the results, at least +-5 and at most +-100.
std::pair<double, double> bias_range(const LabTable& table) {
  double low = -5, high = 5;
  for (const LabResult& r : table.results) {
    low = std::min(low, 100 * r.bias() - 2), high = std::max(high, 100 * r.bias() + 2);
  }
  return {std::max(low, -100.0), std::min(high, 100.0)};
}

Panel make_panel(const LabTable& table, PlotAxis axis, double left, double top) {
  double low = kInfinity, high = -kInfinity;
  for (const LabResult& r : table.results) {
    const double v = axis == PlotAxis::angle ? r.angle : std::log10(r.neighbours);
    low = std::min(low, v), high = std::max(high, v);
  }
  if (!(high > low)) high = low + 1;
  const auto [bottom, ceiling] = bias_range(table);
  return {{low, high, left, left + kPanelWidth}, {bottom, ceiling, top + kPanelHeight, top}, axis};
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     text);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1,
                     x2, y2, style);
}

std::string marker(double x, double y, std::size_t kind, const char* colour) {
  const std::string fill = fmt::format("fill=\"{}\"", colour);
  switch (kind % 4) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" {}/>\n", x, y, fill);
    case 1:
      return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"7\" height=\"7\" {}/>\n", x - 3.5,
                         y - 3.5, fill);
    case 2:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 8h-9z\" {}/>\n", x, y - 5, fill);
    default:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 4.5l-4.5 4.5l-4.5 -4.5z\" {}/>\n", x,
                         y - 4.5, fill);
  }
}

std::string axes(const Panel& panel, const std::string& title) {
  const double left = panel.x.from, right = panel.x.to, bottom = panel.y.from, top = panel.y.to;
  std::string svg = text_at((left + right) / 2, top - 10, "middle", title);
  const double step = tick_step(panel.y.high - panel.y.low);
  for (double v = std::ceil(panel.y.low / step) * step; v <= panel.y.high + 1e-9; v += step) {
    const bool zero = std::abs(v) < step / 2;
    svg += line(left, panel.y(v), right, panel.y(v),
                zero ? "stroke=\"#000\" stroke-width=\"1.2\"" : "stroke=\"#ddd\"");
    svg += text_at(left - 6, panel.y(v) + 4, "end", fmt::format("{:g}", zero ? 0.0 : v));
  }
  const bool angle = panel.axis == PlotAxis::angle;
  const double x_step = angle ? tick_step(panel.x.high - panel.x.low) : 1;
  for (double v = std::ceil(panel.x.low / x_step - 1e-9) * x_step + 0.0; v <= panel.x.high + 1e-9;
       v += x_step) {
    svg += line(panel.x(v), bottom, panel.x(v), top, "stroke=\"#ddd\"");
    svg += text_at(panel.x(v), bottom + 15, "middle",
                   fmt::format("{:g}", angle ? v : std::pow(10, v)));
  }
  svg += text_at((left + right) / 2, bottom + 29, "middle",
                 angle ? "angle of the wall [degrees]" : "photons in the look-up");
  svg += fmt::format(
      "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" "
      "text-anchor=\"middle\">bias [%]</text>\n",
      left - 42, (top + bottom) / 2);
  return svg;
}

std::string curve(const Panel& panel, const Series& series, std::size_t kind) {
  const char* colour = kColours[kind % std::size(kColours)];
  std::string path, marks;
  for (const LabResult* r : series.points) {
    const auto height = [&](double bias) {
      return panel.y(std::clamp(100 * bias, panel.y.low, panel.y.high));
    };
    const double x = panel.place(*r), y = height(r->bias());
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    marks += line(x, height(r->bias() - 2 * r->standard_error), x,
                  height(r->bias() + 2 * r->standard_error), fmt::format("stroke=\"{}\"", colour));
    marks += marker(x, y, kind, colour);
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n", path,
                     colour) +
         marks;
}

std::string legend(const std::vector<Series>& all, double top) {
  std::string svg;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x = kLeft + 200 * static_cast<double>(i % 4);
    const double y = top + 20 * static_cast<double>(i / 4);
    const char* colour = kColours[i % std::size(kColours)];
    svg += line(x, y, x + 24, y, fmt::format("stroke=\"{}\" stroke-width=\"1.6\"", colour));
    svg += marker(x + 12, y, i, colour);
    svg += text_at(x + 30, y + 4, "start", all[i].kernel);
  }
  return svg;
}

}  // namespace

std::string to_svg(const std::vector<LabTable>& tables, PlotAxis axis) {
  const auto rows = (static_cast<int>(tables.size()) + kColumns - 1) / kColumns;
  const double row_height = kTop + kPanelHeight + kGap;
  const std::size_t kernels = tables.empty() ? 0 : series_of(tables[0]).size();
  const double legend_height = 20 * std::ceil(static_cast<double>(kernels) / 4) + 16;
  const double width = kColumns * (kLeft + kPanelWidth + 24);
  const double height = rows * row_height + legend_height;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const double left = kLeft + static_cast<double>(i % kColumns) * (kLeft + kPanelWidth + 24);
    const double top = kTop + static_cast<double>(i / kColumns) * row_height;
    const Panel panel = make_panel(tables[i], axis, left, top);
    svg += axes(panel, tables[i].title);
    const std::vector<Series> all = series_of(tables[i]);
    for (std::size_t k = 0; k < all.size(); ++k) svg += curve(panel, all[k], k);
  }
  if (!tables.empty()) svg += legend(series_of(tables[0]), rows * row_height + 10);
  return svg + "</svg>\n";
}

}  // namespace octolux
