// axes.h.
#include "tools/plot/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octolux {
namespace {

constexpr Ink kInks[] = {{0x00, 0x72, 0xb2}, {0xd5, 0x5e, 0x00}, {0x00, 0x9e, 0x73},
                         {0xcc, 0x79, 0xa7}, {0xe6, 0x9f, 0x00}, {0x56, 0xb4, 0xe9},
                         {0x00, 0x00, 0x00}, {0x99, 0x99, 0x33}};
constexpr double kCurveWidth = 1.6;
constexpr double kRounding = 1e-9;  // of a step: ticks at the very ends count as inside

/// A step of 1, 2 or 5 times a power of ten that cuts `range` into about five.
double tick_step(double range) {
  const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (rough <= step * power) return step * power;
  }
  return 10 * power;
}

std::vector<double> even_ticks(double low, double high) {
  const double step = tick_step(high - low);
  std::vector<double> ticks;
  const auto last = std::floor(high / step + kRounding);
  for (double i = std::ceil(low / step - kRounding); i <= last; ++i)
    ticks.push_back(i * step + 0.0);
  return ticks;
}

/// Powers of ten, and the fewer of them the more of their multiples.
std::vector<double> log_ticks(double low, double high) {
  const double decades = std::log10(high / low);
  std::vector<double> steps{1};
  if (decades < 4.5) steps = {1, 3};
  if (decades < 2.5) steps = {1, 2, 5};
  if (decades < 1.3) steps = {1, 1.5, 2, 3, 4, 5, 7};
  std::vector<double> ticks;
  const auto last = std::ceil(std::log10(high));
  for (double power = std::floor(std::log10(low)); power <= last; ++power) {
    for (const double step : steps) {
      const double v = step * std::pow(10, power);
      if (v >= low * (1 - kRounding) && v <= high * (1 + kRounding)) ticks.push_back(v);
    }
  }
  return ticks;
}

/// Of a logarithmic axis: "0.3", "10^5", "3x10^5".
std::string log_label(double value) {
  if (value >= 1e-3 * (1 - kRounding) && value < 1e4 * (1 - kRounding)) {
    return fmt::format("{:.4g}", value);
  }
  const double exponent = std::floor(std::log10(value) + kRounding);
  const std::string factor = fmt::format("{:.2g}", value / std::pow(10, exponent));
  return (factor == "1" ? "" : factor + "x") + fmt::format("10^{:.0f}", exponent);
}

std::string label(const PlotScale& scale, double value) {
  return scale.logarithmic ? log_label(value) : fmt::format("{:.4g}", value);
}

Polyline line(Spot a, Spot b, Ink ink, double width) { return {{a, b}, ink, width, {}}; }

std::vector<Spot> circle(Spot at, double radius) {
  constexpr int kSides = 16;
  std::vector<Spot> points;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    points.push_back({at.x + radius * std::cos(angle), at.y + radius * std::sin(angle)});
  }
  return points;
}

}  // namespace

double PlotScale::operator()(double value) const {
  const double share =
      logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return from + (to - from) * share;
}

std::vector<double> PlotScale::ticks() const {
  return logarithmic ? log_ticks(low, high) : even_ticks(low, high);
}

PlotScale log_scale_around(const std::vector<double>& values, double from, double to) {
  double low = 1e300, high = 0;
  for (const double v : values) low = std::min(low, v), high = std::max(high, v);
  if (!(high > 0)) low = 0.01, high = 1;
  const double widen = std::max(1.25, std::sqrt(10 * low / high));
  return {low / widen, high * widen, from, to, true};
}

Ink curve_ink(std::size_t i) { return kInks[i % std::size(kInks)]; }

Polygon curve_marker(std::size_t i, Spot at) {
  const Ink ink = curve_ink(i);
  const auto [x, y] = at;
  switch ((i + i / std::size(kInks)) % 4) {
    case 0:
      return {circle(at, 3.8), ink};
    case 1:
      return {{{x - 3.5, y - 3.5}, {x + 3.5, y - 3.5}, {x + 3.5, y + 3.5}, {x - 3.5, y + 3.5}},
              ink};
    case 2:
      return {{{x, y - 5}, {x + 4.5, y + 3}, {x - 4.5, y + 3}}, ink};
    default:
      return {{{x, y - 4.8}, {x + 4.8, y}, {x, y + 4.8}, {x - 4.8, y}}, ink};
  }
}

void draw_axes(Drawing& drawing, const PlotPanel& panel) {
  const double left = panel.x.from, right = panel.x.to, bottom = panel.y.from, top = panel.y.to;
  auto& items = drawing.items;
  for (const double v : panel.x.ticks()) {
    items.push_back(line({panel.x(v), bottom}, {panel.x(v), top}, kGrid, 1));
    items.push_back(Words{{panel.x(v), bottom + 15}, label(panel.x, v), Words::Anchor::middle});
  }
  for (const double v : panel.y.ticks()) {
    const bool zero = !panel.y.logarithmic && v == 0;
    items.push_back(
        line({left, panel.y(v)}, {right, panel.y(v)}, zero ? kBlack : kGrid, zero ? 1.2 : 1));
    items.push_back(
        Words{{left - 6, panel.y(v) + 4}, label(panel.y, v / panel.y_unit), Words::Anchor::end});
  }
  items.push_back(Words{{(left + right) / 2, top - 10}, panel.title, Words::Anchor::middle});
  items.push_back(Words{{(left + right) / 2, bottom + 30}, panel.x_title, Words::Anchor::middle});
  items.push_back(
      Words{{left - 42, (top + bottom) / 2}, panel.y_title, Words::Anchor::middle, true});
}

void draw_curve(Drawing& drawing, const PlotPanel& panel, const std::vector<PlotPoint>& points,
                std::size_t i) {
  const auto height = [&](double y) { return panel.y(std::clamp(y, panel.y.low, panel.y.high)); };
  Polyline path{{}, curve_ink(i), kCurveWidth, {}};
  for (const PlotPoint& p : points) path.points.push_back({panel.x(p.x), height(p.y)});
  drawing.items.push_back(path);
  for (const PlotPoint& p : points) {
    const Spot at{panel.x(p.x), height(p.y)};
    if (p.high > p.low) {
      drawing.items.push_back(line({at.x, height(p.low)}, {at.x, height(p.high)}, path.ink, 1));
    }
    drawing.items.push_back(curve_marker(i, at));
  }
}

void draw_power_law(Drawing& drawing, const PlotPanel& panel, double slope, double x, double y) {
  double left = panel.x.low, right = panel.x.high;
  const auto at = [&](double v) { return y * std::pow(v / x, slope); };
  if (slope != 0) {
    const double bottom = x * std::pow(panel.y.low / y, 1 / slope);
    const double top = x * std::pow(panel.y.high / y, 1 / slope);
    left = std::max(left, std::min(bottom, top));
    right = std::min(right, std::max(bottom, top));
  }
  if (!(right > left)) return;
  drawing.items.push_back(
      Polyline{{{panel.x(left), panel.y(at(left))}, {panel.x(right), panel.y(at(right))}},
               kGuide,
               1,
               {5, 4}});
}

void draw_key(Drawing& drawing, Spot at, std::size_t i, const std::string& text) {
  drawing.items.push_back(line(at, {at.x + 24, at.y}, curve_ink(i), kCurveWidth));
  drawing.items.push_back(curve_marker(i, {at.x + 12, at.y}));
  drawing.items.push_back(Words{{at.x + 30, at.y + 4}, text});
}

}  // namespace octolux
