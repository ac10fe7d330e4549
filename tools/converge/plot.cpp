// study.h: the plot. Log-log panels of one time axis; bars are two standard errors of the mean over
// the seeds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tools/converge/study.h"
#include "tools/plot/axes.h"

namespace octolux {
namespace {

constexpr double kWidth = 900, kLeft = 64, kRight = 24, kTop = 56;
constexpr double kMainHeight = 330, kSmallHeight = 210, kKeyRow = 20, kAxis = 66;
constexpr int kKeys = 2;

/// How a point is drawn in one of the panels; empty: it is not.
using Place = std::function<std::optional<PlotPoint>(const SeriesPoint&)>;

/// The root of a square with two standard errors to each side; none for what is not above 0.
std::optional<PlotPoint> root_point(double seconds, double square, double standard_error) {
  if (!(square > 0) || !(seconds > 0)) return std::nullopt;
  const double bar = standard_error >= 0 ? 2 * standard_error : 0;
  return PlotPoint{seconds, std::sqrt(square), std::sqrt(std::max(0.0, square - bar)),
                   std::sqrt(square + bar)};
}

std::optional<PlotPoint> error_point(const SeriesPoint& p) {
  return root_point(p.seconds, p.rel_mse - p.floor, p.rel_mse_error);
}

std::optional<PlotPoint> noise_point(const SeriesPoint& p) {
  return root_point(p.seconds, p.noise2.value_or(0), 0);
}

/// Only where it is more than chance: above two standard errors.
std::optional<PlotPoint> bias_point(const SeriesPoint& p) {
  const double bias2 = p.bias2.value_or(0), error = p.bias2_error.value_or(0);
  if (bias2 <= 2 * error) return std::nullopt;
  return root_point(p.seconds, bias2, error);
}

std::vector<PlotPoint> points_of(const Series& series, const Place& place) {
  std::vector<PlotPoint> points;
  for (const SeriesPoint& p : series.points) {
    if (const std::optional<PlotPoint> point = place(p)) points.push_back(*point);
  }
  return points;
}

PlotPanel make_panel(const Study& study, const Place& place, const PlotPanel& frame) {
  std::vector<double> times, values;
  for (const Series& series : study.series) {
    for (const SeriesPoint& p : series.points) times.push_back(p.seconds);
    for (const PlotPoint& p : points_of(series, place)) values.push_back(p.y);
  }
  PlotPanel panel = frame;
  panel.x = log_scale_around(times, frame.x.from, frame.x.to);
  panel.y = log_scale_around(values, frame.y.from, frame.y.to);
  panel.x_title = study.time_unit;
  panel.y_unit = 0.01;
  return panel;
}

void draw_series(Drawing& drawing, const Study& study, const PlotPanel& panel, const Place& place) {
  draw_axes(drawing, panel);
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    draw_curve(drawing, panel, points_of(study.series[i], place), i);
  }
}

/// The targets, and how noise alone would fall.
void draw_guides(Drawing& drawing, const PlotPanel& panel) {
  for (const double target : kTargets) {
    if (target > panel.y.low && target < panel.y.high) {
      draw_power_law(drawing, panel, 0, panel.x.low, target);
    }
  }
  const double start = panel.y.high / 1.1;
  draw_power_law(drawing, panel, -0.5, panel.x.low, start);
  drawing.items.push_back(Words{{panel.x.to - 4, panel.y.to + 14},
                                "dashed: targets, and slope -1/2 (noise alone)",
                                Words::Anchor::end,
                                false,
                                false,
                                kGuide});
}

void draw_keys(Drawing& drawing, const Study& study, double top) {
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    const Spot at{kLeft + static_cast<double>(i % kKeys) * (kWidth - kLeft) / kKeys,
                  top + kKeyRow * static_cast<double>(i / kKeys)};
    draw_key(drawing, at, i, study.series[i].name + ": slope " + to_text(study.slopes[i]));
  }
}

}  // namespace

Drawing draw(const Study& study) {
  const double rows = std::ceil(static_cast<double>(study.series.size()) / kKeys);
  const double keys_top = kTop + kMainHeight + 50;
  const double small_top = keys_top + rows * kKeyRow + 30;
  Drawing drawing;
  drawing.width = kWidth;
  drawing.height = small_top + kSmallHeight + 44;
  drawing.items.push_back(Words{
      {kLeft, 22}, "Error against time: " + study.scene, Words::Anchor::start, false, true, {}});
  const double middle = (kWidth + kAxis) / 2;
  PlotPanel frame;
  frame.x = {0, 1, kLeft, kWidth - kRight, true};
  frame.y = {0, 1, kTop + kMainHeight, kTop, true};
  frame.title = fmt::format("{}x{} pixels, {} seeds, bars: two standard errors", study.width,
                            study.height, study.seeds);
  frame.y_title = "error [%]";
  const PlotPanel main = make_panel(study, error_point, frame);
  draw_series(drawing, study, main, error_point);
  draw_guides(drawing, main);
  draw_keys(drawing, study, keys_top);

  frame.x = {0, 1, kLeft, middle - kAxis, true};
  frame.y = {0, 1, small_top + kSmallHeight, small_top, true};
  frame.title = "noise: spread between seeds", frame.y_title = "noise [%]";
  draw_series(drawing, study, make_panel(study, noise_point, frame), noise_point);
  frame.x = {0, 1, middle + 20, kWidth - kRight, true};
  frame.title = "bias, where it is above chance", frame.y_title = "bias [%]";
  draw_series(drawing, study, make_panel(study, bias_point, frame), bias_point);
  const bool none = std::all_of(study.series.begin(), study.series.end(), [](const Series& series) {
    return points_of(series, bias_point).empty();
  });
  if (none) {
    drawing.items.push_back(Words{{(frame.x.from + frame.x.to) / 2, small_top + kSmallHeight / 2},
                                  "none",
                                  Words::Anchor::middle,
                                  false,
                                  false,
                                  kGuide});
  }
  return drawing;
}

}  // namespace octolux
