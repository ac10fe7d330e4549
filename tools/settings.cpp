// settings.h. Numbers are read by std::from_chars: no locale, no trailing rubbish.
#include "tools/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "core/error.h"

namespace octolux {
namespace {

constexpr Shortcut kShortcuts[] = {
    {"--kernel", "estimator.kernel", "NAME",
     "Density estimator: disc, cone, octobox, hull, feeler or region"},
    {"--octants", "estimator.octants", "auto|one|eight",
     "OctoBoxes: one, one per octant, or as the photons allow"},
    {"--feelers", "estimator.feelers", "8|4",
     "Rays around a look-up of the kernels feeler and region"},
    {"--correction", "estimator.correction", "on|off",
     "Estimators unbiased at finite photon counts; off: as published"},
    {"--neighbours", "estimator.neighbours", "N",
     "Photons in a look-up; their extent is the bandwidth"},
    {"--photons", "photons.global", "N", "Photon paths per pass for the global map"},
    {"--caustic-photons", "photons.caustic", "N", "Photon paths per pass for the caustic map"},
    {"--gather", "eye.gather", "on|off", "Final gathering; off shows the global map itself"},
    {"--passes", "stop.passes", "N", "Stop after N passes", true},
    {"--spp", "stop.samples", "N", "Stop after N eye samples per pixel", true},
    {"--time", "stop.seconds", "SECONDS", "Stop after this time", true},
    {"--error", "stop.error", "E", "Stop at this mean relative standard error, e.g. 0.01", true},
    {"--seed", "seed", "N", "Another seed is another, independent picture"},
};

/// `text` as a T, all of it; empty if it is not one.
template <class T>
std::optional<T> parse(const std::string& text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || stop != end) return std::nullopt;
  return value;
}

[[noreturn]] void fail(const std::string& source, const std::string& expected,
                       const std::string& text) {
  throw Error(source + ": expected " + expected + ", not '" + text + "'");
}

void assign(const std::string&, std::string& value, const std::string& text) { value = text; }

void assign(const std::string& source, bool& value, const std::string& text) {
  if (text == "on" || text == "true") {
    value = true;
  } else if (text == "off" || text == "false") {
    value = false;
  } else {
    fail(source, "on or off", text);
  }
}

template <class T>
requires std::is_floating_point_v<T>
void assign(const std::string& source, T& value, const std::string& text) {
  value = static_cast<T>(parse_number(source, text));
}

template <class T>
requires std::is_integral_v<T>
void assign(const std::string& source, T& value, const std::string& text) {
  const std::optional<T> parsed = parse<T>(text);
  if (!parsed)
    fail(source, std::is_signed_v<T> ? "a whole number" : "a whole number, 0 or more", text);
  value = *parsed;
}

std::string to_text(bool value) { return value ? "on" : "off"; }
template <class T>
std::string to_text(const T& value) {
  return fmt::format("{}", value);
}

}  // namespace

std::span<const Shortcut> shortcuts() { return kShortcuts; }

void set_setting(RenderConfig& config, const std::string& source, const std::string& key,
                 const std::string& text) {
  std::vector<std::string> keys;
  bool found = false;
  visit(config, [&](const std::string& name, auto& value) {
    keys.push_back(name);
    if (name != key) return;
    found = true;
    assign(source, value, text);
  });
  if (!found) throw Error(source + ": " + unknown_name("setting", key, keys));
}

std::string get_setting(const RenderConfig& config, const std::string& key) {
  std::string text;
  visit(config, [&](const std::string& name, const auto& value) {
    if (name == key) text = to_text(value);
  });
  return text;
}

std::string list_settings(const RenderConfig& config, const std::vector<std::string>& left_out) {
  std::string text;
  visit(config, [&](const std::string& name, const auto& value) {
    if (std::find(left_out.begin(), left_out.end(), name) != left_out.end()) return;
    text += fmt::format("  {}={}\n", name, to_text(value));
  });
  return text;
}

int parse_int(const std::string& source, const std::string& text, int lowest, int highest) {
  const std::optional<int> value = parse<int>(text);
  if (!value || *value < lowest || *value > highest) {
    fail(source, fmt::format("a whole number from {} to {}", lowest, highest), text);
  }
  return *value;
}

double parse_number(const std::string& source, const std::string& text) {
  const std::optional<double> value = parse<double>(text);
  if (!value || !std::isfinite(*value)) fail(source, "a number", text);
  return *value;
}

Integrator parse_integrator(const std::string& name) {
  if (name == "photon") return Integrator::photon;
  if (name == "path") return Integrator::path;
  throw Error(unknown_name("integrator", name, {"photon", "path"}));
}

}  // namespace octolux
