// report.h.
#include "tools/ab/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace octolux {
namespace {

using Json = nlohmann::ordered_json;

Json settings_of(const RenderConfig& config) {
  Json json = Json::object();
  visit(config, [&](const std::string& name, const auto& value) { json[name] = value; });
  return json;
}

Json figures_of(const MaskFigures& f) {
  Json json = {
      {"pixels", f.leaks.pixels}, {"light-leak", f.leaks.light}, {"shadow-leak", f.leaks.shadow}};
  if (f.leaks.noise) json["noise"] = *f.leaks.noise;
  Json& figures = json["figures"] = Json::object();
  for (const Figure& figure : octolux::figures()) {
    const std::optional<double> value = figure.value(f.comparison);
    // Those of compare are relative to the mask's own mean.
    if (value && !std::string(figure.key).ends_with("-leak")) figures[figure.key] = *value;
  }
  return json;
}

Json to_json(const AbResult& r, const AbPicture& p) {
  Json json = {{"name", p.render.name},
               {"exr", p.render.stem + ".exr"},
               {"png", p.render.stem + ".png"},
               {"settings", settings_of(p.render.config)},
               {"passes", p.progress.passes},
               {"seconds", p.progress.seconds},
               {"rays", p.progress.rays},
               {"photons-global", p.progress.global_photons},
               {"photons-caustic", p.progress.caustic_photons},
               {"masks", Json::object()}};
  for (std::size_t m = 0; m < r.masks.size(); ++m) {
    json["masks"][r.masks[m].key] = figures_of(p.masks[m]);
  }
  return json;
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.2f} %", 100 * share) : "-";
}

/// A column of the table: its head, and a picture's cell.
struct Column {
  std::string head;
  std::function<std::string(const AbPicture&)> cell;
};

std::vector<Column> columns_of(const AbResult& r) {
  std::vector<Column> columns = {
      {"picture", [](const AbPicture& p) { return p.render.name; }},
      {"passes", [](const AbPicture& p) { return fmt::format("{}", p.progress.passes); }},
      {"time", [](const AbPicture& p) { return fmt::format("{:.1f} s", p.progress.seconds); }},
      {"relMSE", [](const AbPicture& p) {
         return number_text(p.masks.front().comparison.metrics.rel_mse, 3);
       }}};
  const auto add = [&](const std::string& head, std::size_t m, double LeakFigures::*member) {
    columns.push_back(
        {head, [m, member](const AbPicture& p) { return percent(p.masks[m].leaks.*member); }});
  };
  for (std::size_t m = 0; m < r.masks.size(); ++m) {
    const std::string& key = r.masks[m].key;
    if (key == "open") continue;  // nothing there to leak; the page has it
    const std::string where = m == 0 ? "" : ", " + r.masks[m].title;
    add("light leak" + where, m, &LeakFigures::light);
    if (key == "sealed") continue;  // no shadow can be darker than the dark
    add("shadow leak" + where, m, &LeakFigures::shadow);
    columns.push_back({"noise" + where, [m](const AbPicture& p) {
                         const auto& noise = p.masks[m].leaks.noise;
                         return noise ? percent(*noise) : "-";
                       }});
  }
  return columns;
}

std::string rule_of(const StopConfig& stop) {
  return stop.seconds > 0 ? fmt::format("{:g} s each", stop.seconds)
                          : fmt::format("{} passes each", stop.passes);
}

}  // namespace

std::vector<std::string> explanations(const AbResult& r) {
  const RenderConfig& c = r.pictures.front().render.config;
  std::vector<std::string> lines = {
      fmt::format(
          "Scene {} at {}x{} pixels; photon paths per pass {}, photons in a look-up {}, {}.",
          r.scene, r.width(), r.height(), c.photons.global, c.estimator.neighbours,
          rule_of(c.stop)),
      "x is a picture, y the reference: " + r.reference_origin + ".",
      "Light leak: x brighter than y, as where light comes through a wall. Shadow leak: x darker, "
      "as "
      "where a look-up reaches beyond a wall and finds no photons there. Both in units of mean y.",
      "Noise is what each leak would read were there no other error: with any noise x is now "
      "above, "
      "now below y."};
  for (const NamedMask& m : r.masks) {
    if (m.key == "image") continue;
    const double share = 100.0 * static_cast<double>(m.pixels) / (double(r.width()) * r.height());
    lines.push_back(fmt::format("{}: {:.3g} % of the pixels, {}.", m.title, share, m.meaning));
  }
  lines.push_back("Made by: " + r.command);
  return lines;
}

Json to_json(const AbResult& r) {
  Json json = {{"octolux", OCTOLUX_VERSION},
               {"command", r.command},
               {"scene", r.scene},
               {"scene-hash", fmt::format("{:016x}", r.scene_hash)},
               {"width", r.width()},
               {"height", r.height()},
               {"reference", r.reference_origin},
               {"formulas", Json::object()},
               {"masks", Json::object()},
               {"renders", Json::array()}};
  for (const Figure& figure : figures()) json["formulas"][figure.key] = figure.formula;
  json["formulas"]["light-leak"] = kLightLeakFormula;
  json["formulas"]["shadow-leak"] = kShadowLeakFormula;
  json["formulas"]["noise"] = kNoiseFormula;
  for (const NamedMask& m : r.masks) {
    json["masks"][m.key] = {{"title", m.title}, {"meaning", m.meaning}, {"pixels", m.pixels}};
  }
  for (const AbPicture& p : r.pictures) json["renders"].push_back(to_json(r, p));
  return json;
}

std::string to_markdown(const AbResult& r) {
  const std::vector<Column> columns = columns_of(r);
  std::vector<std::vector<std::string>> rows(2 + r.pictures.size());
  for (const Column& column : columns) {
    rows[0].push_back(column.head);
    rows[1].push_back(rows[1].empty() ? "---" : "---:");
    for (std::size_t i = 0; i < r.pictures.size(); ++i) {
      rows[2 + i].push_back(column.cell(r.pictures[i]));
    }
  }
  std::string text;
  for (const auto& row : rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text;
}

}  // namespace octolux
