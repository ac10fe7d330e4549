// Everything `octolux converge` found, in one structure from which text, CSV, JSON, plot and page
// are made, so that all show the same numbers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/converge/fit.h"
#include "tools/plot/drawing.h"

namespace octolux {

/// The errors whose price is asked for: 10 %, 3 %, 1 %.
inline constexpr double kTargets[] = {0.1, 0.03, 0.01};

struct Study {
  std::string command, scene, reference;  // reference: what it is, in words
  int width = 0, height = 0, seeds = 0;
  std::string time_unit;  // "seconds" or "CPU seconds"
  std::vector<Series> series;
  std::vector<std::optional<Slope>> slopes;  // of each series
  std::vector<Winner> winners;               // of each target
  std::vector<std::string> warnings;
};

/// Fills in slopes, winners and warnings from the series.
void conclude(Study& study);

/// Tables for a terminal.
std::string to_text(const Study& study);
std::string to_csv(const Study& study);
nlohmann::ordered_json to_json(const Study& study);

/// Error over time, and below it noise and bias, all log-log.
Drawing draw(const Study& study);

/// A web page that opens from disk: plot, conclusions, figures, formulas, and the JSON. `pictures`
/// is the name of a page beside it that shows the pictures; "": there is none.
std::string make_page(const Study& study, const std::string& pictures);

/// The formulas of series.h, for reports: name and text.
struct Formula {
  const char* name;
  const char* text;
};
const std::vector<Formula>& formulas();

/// [%], two decimals: "1.25"; "< 0.80" (with two standard errors) for what is not above chance;
/// "-".
std::string bias_text(const SeriesPoint& point);

/// "-0.50 +- 0.02", or "-".
std::string to_text(const std::optional<Slope>& slope);

}  // namespace octolux
