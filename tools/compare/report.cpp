// report.h.
#include "tools/compare/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace octolux {
namespace {

using Json = nlohmann::ordered_json;

std::string column_name(const Comparison& c, std::size_t image) {
  return c.images.size() == 1 ? "x" : fmt::format("x{}", image + 1);
}

std::string heading(const Comparison& c) {
  std::string text =
      fmt::format("{:<4} {} (reference), {}x{} pixels", "y", c.reference, c.width, c.height);
  if (!c.mask.empty()) text += fmt::format(", {} of them count: {}", c.mask_pixels, c.mask);
  text += "\n";
  for (std::size_t i = 0; i < c.images.size(); ++i) {
    text += fmt::format("{:<4} {}\n", column_name(c, i), c.images[i].image);
  }
  return text;
}

/// One layer of all images.
std::string table(const Comparison& c, std::size_t layer) {
  const LayerComparison& first = c.images.front().layers[layer];
  std::string text = fmt::format("\n{:<18}", layer_title(first.layer));
  for (std::size_t i = 0; i < c.images.size(); ++i) {
    text += fmt::format("{:>12}", column_name(c, i));
  }
  text += "\n";
  for (const Figure& figure : figures()) {
    std::string row = fmt::format("  {:<16}", figure.title);
    bool any = false;
    for (const ImageComparison& image : c.images) {
      const std::optional<double> value = figure.value(image.layers[layer]);
      row += value ? fmt::format("{:>12}", number_text(*value, 5)) : fmt::format("{:>12}", "-");
      any |= value.has_value();
    }
    if (any) text += row + "   " + figure.formula + "\n";
  }
  return text;
}

std::string place(const Comparison& c, std::int64_t pixel) {
  return fmt::format("{},{}", pixel % c.width, pixel / c.width);
}

std::string bad_values(const Comparison& c, const std::string& name, const BadValues& bad) {
  if (bad.non_finite() == 0) return "";
  return fmt::format("warning: {}: {} pixels NaN and {} infinite, the first at {}; left out\n",
                     name, bad.nan, bad.infinite, place(c, bad.first));
}

std::string noise_line(const Comparison& c, const std::string& name, const NoiseTest& test) {
  if (test.largest_at < 0) return fmt::format("noise: {}: no value has a variance\n", name);
  return fmt::format(
      "noise: {}: {} ({} of {} values beyond it; largest deviate {:+.3g} at {}, p {:.2g}; Sidak's "
      "limit {:.2g} for {:g} in all)\n",
      name, test.differ() ? "differs by more than noise" : "within noise", test.rejected,
      test.tested, test.largest, place(c, test.largest_at), test.smallest_p, test.sidak_alpha,
      test.alpha);
}

std::string remarks(const Comparison& c, std::size_t layer) {
  const LayerComparison& first = c.images.front().layers[layer];
  std::string text = bad_values(c, c.reference, first.metrics.reference);
  for (const ImageComparison& image : c.images) {
    const LayerComparison& l = image.layers[layer];
    text += bad_values(c, image.image, l.metrics.image);
    if (l.metrics.image.negative > 0 && l.channels.front() == "R") {
      text += fmt::format("note: {}: {} negative values\n", image.image, l.metrics.image.negative);
    }
    if (l.noise) text += noise_line(c, image.image, *l.noise);
  }
  return text;
}

Json to_json(const BadValues& bad) {
  return {{"nan", bad.nan}, {"infinite", bad.infinite}, {"negative", bad.negative}};
}

Json to_json(const NoiseTest& t, int width) {
  Json json = {{"alpha", t.alpha},       {"sidak_alpha", t.sidak_alpha}, {"tested", t.tested},
               {"untested", t.untested}, {"rejected", t.rejected},       {"differ", t.differ()}};
  if (t.largest_at < 0) return json;
  json["largest_deviate"] = t.largest;
  json["smallest_p"] = t.smallest_p;
  json["largest_at"] = {t.largest_at % width, t.largest_at / width};
  return json;
}

Json to_json(const LayerComparison& l, int width) {
  Json json = {{"layer", l.layer}, {"channels", l.channels}, {"pixels", l.metrics.pixels}};
  Json& values = json["figures"] = Json::object();
  for (const Figure& figure : figures()) {
    const std::optional<double> value = figure.value(l);
    if (value) values[figure.key] = *value;
  }
  json["bad_values"] = {{"image", to_json(l.metrics.image)},
                        {"reference", to_json(l.metrics.reference)}};
  if (l.noise) json["noise_test"] = to_json(*l.noise, width);
  if (l.flip) {
    const FlipExposures& e = l.flip->exposures;
    json["flip_exposures"] = {{"start", e.start}, {"stop", e.stop}, {"count", e.count}};
  }
  return json;
}

}  // namespace

std::string to_text(const Comparison& c) {
  std::string text = heading(c);
  for (std::size_t layer = 0; layer < c.images.front().layers.size(); ++layer) {
    text += table(c, layer) + remarks(c, layer);
  }
  return text;
}

Json to_json(const Comparison& c, const std::vector<GateResult>& gates) {
  Json json = {{"octolux", OCTOLUX_VERSION}, {"reference", c.reference}, {"width", c.width},
               {"height", c.height},         {"mask", c.mask},           {"counted", c.mask_pixels},
               {"formulas", Json::object()}, {"images", Json::array()},  {"gates", Json::array()}};
  for (const Figure& figure : figures()) json["formulas"][figure.key] = figure.formula;
  for (const ImageComparison& image : c.images) {
    Json layers = Json::array();
    for (const LayerComparison& layer : image.layers) layers.push_back(to_json(layer, c.width));
    json["images"].push_back({{"image", image.image}, {"layers", layers}});
  }
  for (const GateResult& gate : gates) {
    json["gates"].push_back({{"image", gate.image},
                             {"layer", gate.layer},
                             {"gate", gate.gate},
                             {"passed", gate.passed},
                             {"says", gate.line}});
  }
  return json;
}

}  // namespace octolux
