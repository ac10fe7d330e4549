// plot.h. Every panel has a legend of its own, with the slope each curve ends with, and a dashed
// line of the slope that would be ideal. What the words mean stands beside the last one.
#include "tools/bench/scaling/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "tools/plot/axes.h"

namespace octolux {
namespace {

constexpr double kPanelWidth = 300, kPanelHeight = 230;
constexpr double kLeft = 62, kRight = 22, kTop = 40, kBelow = 66, kTitle = 28;
constexpr double kNoteRow = 20;
constexpr std::size_t kColumns = 3;

std::vector<PlotPoint> points_of(const ScalingCurve& curve, std::size_t quantity) {
  std::vector<PlotPoint> points;
  for (const ScalingStep& step : curve.steps) points.push_back({step.size, step.values[quantity]});
  return points;
}

/// Numbers of those quantities that are times.
std::vector<std::size_t> times_of(const ScalingCurve& curve) {
  std::vector<std::size_t> times;
  for (std::size_t q = 0; q < curve.sweep.quantities.size(); ++q) {
    if (curve.sweep.quantities[q].is_time()) times.push_back(q);
  }
  return times;
}

PlotPanel make_panel(const ScalingCurve& curve, Spot corner) {
  std::vector<double> sizes, seconds;
  for (const std::size_t q : times_of(curve)) {
    for (const PlotPoint& p : points_of(curve, q)) sizes.push_back(p.x), seconds.push_back(p.y);
  }
  PlotPanel panel;
  panel.x = log_scale_around(sizes, corner.x, corner.x + kPanelWidth);
  panel.y = log_scale_around(seconds, corner.y + kPanelHeight, corner.y);
  panel.title = curve.sweep.title;
  panel.x_title = curve.sweep.unit;
  panel.y_title = "time [s]";
  return panel;
}

/// Below the panel.
void draw_keys(Drawing& drawing, const PlotPanel& panel, const ScalingCurve& curve) {
  const std::vector<std::size_t> times = times_of(curve);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double slope = curve.last_slope(times[i]);
    const std::string ending = std::isfinite(slope) ? fmt::format(": slope {:.2f}", slope) : "";
    const Spot at{panel.x.from + static_cast<double>(i) * kPanelWidth / 2, panel.y.from + 50};
    draw_key(drawing, at, i, curve.sweep.quantities[times[i]].name + ending);
  }
}

void draw_panel(Drawing& drawing, const ScalingCurve& curve, Spot corner) {
  const PlotPanel panel = make_panel(curve, corner);
  draw_axes(drawing, panel);
  const std::vector<std::size_t> times = times_of(curve);
  const ScalingStep& anchor = curve.sweep.ideal_slope > 0 ? curve.steps.back() : curve.steps[0];
  draw_power_law(drawing, panel, curve.sweep.ideal_slope, anchor.size, anchor.values[times[0]]);
  for (std::size_t i = 0; i < times.size(); ++i) {
    draw_curve(drawing, panel, points_of(curve, times[i]), i);
  }
  draw_keys(drawing, panel, curve);
}

/// Where the next panel would be.
void draw_notes(Drawing& drawing, Spot corner) {
  const std::string notes[] = {
      fmt::format("{} threads, except where they vary", thread_count()),
      "slopes: of log time against log size, last decade",
      "dashed: time in proportion to the size, slope 1",
      "(in inverse proportion to threads, slope -1)",
      "",
      "pass: photon mapping at default settings",
      "load: scene file and meshes, tree for rays included",
      "trace, build map: photons followed and stored",
  };
  for (const std::string& note : notes) {
    drawing.items.push_back(Words{corner, note});
    corner.y += kNoteRow;
  }
}

}  // namespace

Drawing draw(const std::vector<ScalingCurve>& curves) {
  const std::size_t cells = curves.size() + 1, columns = std::min(kColumns, cells);
  const std::size_t rows = (cells + columns - 1) / columns;
  const double width = kLeft + kPanelWidth + kRight, height = kTop + kPanelHeight + kBelow;
  const auto corner = [&](std::size_t cell) {
    return Spot{kLeft + static_cast<double>(cell % columns) * width,
                kTitle + kTop + static_cast<double>(cell / columns) * height};
  };
  Drawing drawing;
  drawing.width = static_cast<double>(columns) * width;
  drawing.height = kTitle + static_cast<double>(rows) * height;
  drawing.items.push_back(
      Words{{kLeft, kTitle}, "How time grows", Words::Anchor::start, false, true, {}});
  for (std::size_t i = 0; i < curves.size(); ++i) draw_panel(drawing, curves[i], corner(i));
  const Spot notes = corner(curves.size());
  draw_notes(drawing, {notes.x, notes.y + kNoteRow});
  return drawing;
}

}  // namespace octolux
