// study.h: conclusions, text, CSV and JSON.
#include "tools/converge/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace octolux {
namespace {

using Json = nlohmann::ordered_json;

/// What is not known becomes null, as what is not finite does by itself.
Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::string cell(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.6g}", *value) : "";
}

std::optional<double> root(const std::optional<double>& square) {
  if (!square) return std::nullopt;
  return std::sqrt(std::max(0.0, *square));
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

void warn(Study& study, const Series& series) {
  const SeriesPoint& last = series.points.back();
  if (last.rel_mse < 2 * last.floor) {
    study.warnings.push_back(
        fmt::format("{}: its last error is less than the reference's own noise; a better reference "
                    "(--reference-error) would tell more",
                    series.name));
  }
  if (last.non_finite > 0) {
    study.warnings.push_back(fmt::format("{}: {} pixels are not finite and were left out",
                                         series.name, last.non_finite));
  }
  if (series.points.size() < 3) {
    study.warnings.push_back(fmt::format(
        "{}: fewer than three points, so no slope; more --time would give some", series.name));
  }
}

Json point_json(const SeriesPoint& p) {
  Json point;
  point["passes"] = p.passes;
  point["seconds"] = p.seconds;
  point["relmse"] = p.rel_mse;
  point["relmse_standard_error"] = p.rel_mse_error;
  point["trimmed_relmse"] = p.trimmed_rel_mse;
  point["mean_ratio"] = p.mean_ratio;
  point["reference_noise2"] = p.floor;
  point["error"] = p.error();
  point["noise"] = json_of(root(p.noise2));
  point["bias"] = json_of(root(p.bias2));
  point["bias2"] = json_of(p.bias2);
  point["bias2_standard_error"] = json_of(p.bias2_error);
  point["non_finite_pixels"] = p.non_finite;
  for (const SeedPoint& s : p.seeds) {
    point["seeds"].push_back({{"seconds", s.seconds},
                              {"relmse", s.rel_mse},
                              {"trimmed_relmse", s.trimmed_rel_mse},
                              {"mean_ratio", s.mean_ratio}});
  }
  return point;
}

Json winner_json(const Winner& winner, const std::vector<Series>& series) {
  constexpr const char* kKinds[] = {"reached", "before the first point", "foreseen", "never"};
  Json json;
  json["error"] = winner.target;
  json["text"] = to_text(winner, series);
  json["fastest"] = winner.series < 0 ? Json(nullptr) : Json(series[winner.series].name);
  json["foreseen"] = winner.foreseen;
  json["level_with"] = Json::array();
  for (const int i : winner.level_with) json["level_with"].push_back(series[i].name);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const TimeToTarget& t = winner.times[i];
    const bool known = t.kind != TimeToTarget::Kind::never;
    json["times"].push_back(
        {{"series", series[i].name},
         {"kind", kKinds[static_cast<int>(t.kind)]},
         {"seconds", known ? Json(t.seconds) : Json(nullptr)},
         {"relative_standard_error", known ? Json(t.log_error) : Json(nullptr)}});
  }
  return json;
}

}  // namespace

const std::vector<Formula>& formulas() {
  static const std::vector<Formula> all = {
      {"relMSE", "mean of (x-y)^2/(y^2+0.01) over pixels and channels; x image, y reference"},
      {"error", "sqrt(relMSE - the reference's own noise^2), the mean over seeds"},
      {"noise", "sqrt(mean of s^2/(y^2+0.01)), s^2 the variance between seeds"},
      {"bias",
       "sqrt(error^2 - noise^2), what more seeds do not average away; in tables, < : not above "
       "chance, with two standard errors added"},
      {"slope",
       "of log error over log time, by least squares for each seed; mean and standard "
       "error over seeds. Noise alone falls with slope -0.5"},
  };
  return all;
}

void conclude(Study& study) {
  study.slopes.clear(), study.winners.clear(), study.warnings.clear();
  for (const Series& series : study.series) {
    study.slopes.push_back(fit_slope(series));
    if (!series.points.empty()) warn(study, series);
  }
  for (const double target : kTargets) study.winners.push_back(find_winner(study.series, target));
}

std::string bias_text(const SeriesPoint& p) {
  if (!p.bias2) return "-";
  const double margin = 2 * p.bias2_error.value_or(0);
  if (*p.bias2 > margin || !p.bias2_error) {
    return fmt::format("{:.2f}", 100 * *root(p.bias2));
  }
  return fmt::format("< {:.2f}", 100 * *root(std::max(0.0, *p.bias2) + margin));
}

std::string to_text(const std::optional<Slope>& slope) {
  if (!slope) return "-";
  if (!(slope->standard_error >= 0)) return fmt::format("{:.2f}", slope->value);
  return fmt::format("{:.2f} +- {:.2f}", slope->value, slope->standard_error);
}

std::string to_text(const Study& study) {
  std::string text;
  std::size_t width = 10;
  for (const Series& s : study.series) width = std::max(width, s.name.size() + 2);
  text += fmt::format("{:<{}}{:>7}{:>10}{:>11}{:>9}{:>9}{:>9}\n", "", width, "passes", "time s",
                      "relMSE", "error %", "noise %", "bias %");
  const auto percent = [](const std::optional<double>& v) {
    return v ? fmt::format("{:.2f}", 100 * *v) : std::string("-");
  };
  for (const Series& s : study.series) {
    for (const SeriesPoint& p : s.points) {
      text += fmt::format("{:<{}}{:>7}{:>10.3g}{:>11.3e}{:>9.2f}{:>9}{:>9}\n", s.name, width,
                          p.passes > 0 ? fmt::format("{}", p.passes) : "-", p.seconds, p.rel_mse,
                          100 * p.error(), percent(root(p.noise2)), bias_text(p));
    }
  }
  text += fmt::format("\n{:<{}}{:>16}{:>12}{:>12}{:>12}\n", "", width, "slope", "to 10 %", "to 3 %",
                      "to 1 %");
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    text += fmt::format("{:<{}}{:>16}", study.series[i].name, width, to_text(study.slopes[i]));
    for (const Winner& w : study.winners) text += fmt::format("{:>12}", to_text(w.times[i]));
    text += "\n";
  }
  text += "\n";
  for (const Winner& w : study.winners) text += "fastest " + to_text(w, study.series) + "\n";
  for (const std::string& warning : study.warnings) text += "warning: " + warning + "\n";
  return text;
}

std::string to_csv(const Study& study) {
  std::string text =
      "series,passes,seed,seconds,relmse,trimmed_relmse,mean_ratio,relmse_standard_error,"
      "reference_noise2,error,noise,bias,bias2,bias2_standard_error\n";
  for (const Series& s : study.series) {
    for (const SeriesPoint& p : s.points) {
      const std::string head = quoted(s.name) + fmt::format(",{},", p.passes);
      text += head + fmt::format("mean,{:.6g},{:.6g},{:.6g},{:.6g},{},{:.6g},{:.6g},{},{},{},{}\n",
                                 p.seconds, p.rel_mse, p.trimmed_rel_mse, p.mean_ratio,
                                 cell(p.rel_mse_error), p.floor, p.error(), cell(root(p.noise2)),
                                 cell(root(p.bias2)), cell(p.bias2), cell(p.bias2_error));
      for (std::size_t i = 0; i < p.seeds.size(); ++i) {
        const SeedPoint& seed = p.seeds[i];
        text += head + fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},,,,,,,\n", i + 1, seed.seconds,
                                   seed.rel_mse, seed.trimmed_rel_mse, seed.mean_ratio);
      }
    }
  }
  return text;
}

Json to_json(const Study& study) {
  Json json;
  json["command"] = study.command;
  json["scene"] = study.scene;
  json["width"] = study.width;
  json["height"] = study.height;
  json["reference"] = study.reference;
  json["time"] = study.time_unit;
  for (const Formula& f : formulas()) json["formulas"][f.name] = f.text;
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    Json series;
    series["name"] = study.series[i].name;
    series["external"] = study.series[i].external;
    if (const auto& slope = study.slopes[i]) {
      series["slope"] = {{"value", slope->value},
                         {"standard_error", slope->standard_error},
                         {"points", slope->points},
                         {"seeds", slope->seeds}};
    }
    series["points"] = Json::array();
    for (const SeriesPoint& p : study.series[i].points) series["points"].push_back(point_json(p));
    json["series"].push_back(series);
  }
  for (const Winner& w : study.winners) json["targets"].push_back(winner_json(w, study.series));
  json["warnings"] = study.warnings;
  return json;
}

}  // namespace octolux
