// What plots are made of: scales from data to the page, axes with numbers, curves with markers and
// error bars. Colours are those of Okabe & Ito (2008), for all kinds of colour vision; markers
// differ too, so that a plot can be read in black and white.
#pragma once

#include <string>
#include <vector>

#include "tools/plot/drawing.h"

namespace octolux {

/// From data to the page, straight or logarithmic.
struct PlotScale {
  double low = 0, high = 1;  // data
  double from = 0, to = 1;   // page
  bool logarithmic = false;

  double operator()(double value) const;
  /// The value where numbers and lines of the grid stand, from low to high.
  std::vector<double> ticks() const;
};

/// A logarithmic scale around all values, and at least a decade long.
PlotScale log_scale_around(const std::vector<double>& values, double from, double to);

struct PlotPanel {
  PlotScale x, y;
  std::string title, x_title, y_title;
  double y_unit = 1;  // numbers of the y axis are shown divided by this
};

inline constexpr Ink kBlack{0, 0, 0};
inline constexpr Ink kGrid{0xdd, 0xdd, 0xdd};
inline constexpr Ink kGuide{0x77, 0x77, 0x77};

/// Colour of the i-th curve; they repeat after eight.
Ink curve_ink(std::size_t i);

/// The i-th curve's marker; shapes repeat after four, shifted against the colours.
Polygon curve_marker(std::size_t i, Spot at);

/// Grid, numbers and titles.
void draw_axes(Drawing& drawing, const PlotPanel& panel);

struct PlotPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;  // ends of the error bar; equal: none
};

/// Points joined by a line; what lies beyond the panel is drawn at its rim.
void draw_curve(Drawing& drawing, const PlotPanel& panel, const std::vector<PlotPoint>& points,
                std::size_t i);

/// The part inside a log-log panel of the power law through (x, y), dashed.
void draw_power_law(Drawing& drawing, const PlotPanel& panel, double slope, double x, double y);

/// A bit of the i-th curve, and words behind it.
void draw_key(Drawing& drawing, Spot at, std::size_t i, const std::string& text);

}  // namespace octolux
