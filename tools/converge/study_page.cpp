// study.h: the web page. No script: everything on it is text and the plot's SVG; the JSON is there
// for programs.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/converge/study.h"

namespace octolux {
namespace {

constexpr char kStyle[] = R"(
body { font: 15px/1.5 sans-serif; max-width: 62rem; margin: 1.5rem auto; padding: 0 1rem; color: #111; }
svg { max-width: 100%; height: auto; }
table { border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .7rem; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child { text-align: left; }
thead th { border-bottom: 2px solid #555; }
tr.first td { border-top: 2px solid #999; }
td.best { font-weight: bold; }
dt { font-weight: bold; } dd { margin: 0 0 .4rem 1.5rem; }
.warning { color: #8a3b00; }
)";

std::string tag(const std::string& name, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>\n", name, escape_markup(text));
}

std::string cell(const std::string& text, bool best = false) {
  return fmt::format("<td{}>{}</td>", best ? " class=\"best\"" : "", escape_markup(text));
}

std::string percent_of_root(const std::optional<double>& square) {
  return square ? fmt::format("{:.2f}", 100 * std::sqrt(std::max(0.0, *square))) : "-";
}

std::string target_table(const Study& study) {
  std::string html = "<table id=\"targets\"><thead><tr><th>variant</th><th>slope</th>";
  for (const Winner& w : study.winners) html += fmt::format("<th>to {:g} %</th>", 100 * w.target);
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    html += "<tr>" + cell(study.series[i].name) + cell(to_text(study.slopes[i]));
    for (const Winner& w : study.winners) {
      html += cell(to_text(w.times[i]), w.series == static_cast<int>(i));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string point_table(const Study& study) {
  std::string html =
      "<table id=\"points\"><thead><tr><th>variant</th><th>passes</th><th>" + study.time_unit +
      "</th><th>relMSE</th><th>&plusmn;</th><th>error %</th><th>noise %</th><th>bias %</th>"
      "<th>brightness</th></tr></thead><tbody>\n";
  for (const Series& series : study.series) {
    for (const SeriesPoint& p : series.points) {
      const bool first = &p == &series.points.front();
      html += fmt::format("<tr{}>", first ? " class=\"first\"" : "") +
              cell(first ? series.name : "") +
              cell(p.passes > 0 ? fmt::format("{}", p.passes) : "-") +
              cell(fmt::format("{:.3g}", p.seconds)) + cell(fmt::format("{:.3e}", p.rel_mse)) +
              cell(p.rel_mse_error >= 0 ? fmt::format("{:.1e}", p.rel_mse_error) : "-") +
              cell(fmt::format("{:.2f}", 100 * p.error())) + cell(percent_of_root(p.noise2)) +
              cell(bias_text(p)) + cell(fmt::format("{:.4f}", p.mean_ratio)) + "</tr>\n";
    }
  }
  return html + "</tbody></table>\n";
}

/// JSON that may stand inside a script element.
std::string script_json(const Study& study) {
  std::string text;
  for (const char c : to_json(study).dump(2)) {
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return text;
}

}  // namespace

std::string make_page(const Study& study, const std::string& pictures) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n" +
      tag("title", "Error against time: " + study.scene) + "<style>" + kStyle +
      "</style></head><body>\n" + tag("h1", "Error against time: " + study.scene);
  html += tag("p", fmt::format("{}x{} pixels, {} seeds. Reference: {}.", study.width, study.height,
                               study.seeds, study.reference));
  html += "<ul>\n";
  for (const Winner& w : study.winners) html += tag("li", "Fastest " + to_text(w, study.series));
  html += "</ul>\n";
  for (const std::string& warning : study.warnings) {
    html += "<p class=\"warning\">" + escape_markup(warning) + "</p>\n";
  }
  html += "<div id=\"plot\">" + to_svg(draw(study)) + "</div>\n";
  html += tag("h2", "Time to an error") + target_table(study);
  html += tag("p",
              "< : reached before the first measurement; ~ : not reached, foreseen from the slope, "
              "which a bias that stays would betray; - : the error does not fall. Times are "
              "geometric means over the seeds.");
  if (!pictures.empty()) {
    html +=
        "<p><a href=\"" + escape_markup(pictures) + "\">The last pictures, side by side</a></p>\n";
  }
  html += tag("h2", "Every point") + point_table(study) + "<dl>\n";
  for (const Formula& f : formulas()) html += tag("dt", f.name) + tag("dd", f.text);
  html += "</dl>\n" + tag("p", "Made by: " + study.command);
  html += "<script type=\"application/json\" id=\"data\">\n" + script_json(study) + "\n</script>\n";
  return html + "</body></html>\n";
}

}  // namespace octolux
