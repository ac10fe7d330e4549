// Parsing of numbers, points and colours; transforms are in xml_transform.cpp.
#include "renderer/xml_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/spectrum.h"

namespace octolux {
namespace {

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

std::vector<std::string_view> split_list(std::string_view text) {
  constexpr const char* kSeparators = ", \t\r\n";
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(kSeparators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kSeparators, end);
  }
  return words;
}

std::string quoted(std::string_view text) { return fmt::format("'{}'", text); }

/// from_chars takes no '+'.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return plus ? text.substr(1) : text;
}

/// "#rrggbb", sRGB.
Rgb parse_hex(std::string_view text, const Location& where) {
  unsigned value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + 1, end, value, 16);
  if (text.size() != 7 || stop != end || error != std::errc()) {
    fail(where, quoted(text) + " is not a colour of the form #rrggbb");
  }
  const auto component = [&](unsigned shift) {
    return srgb_to_linear(static_cast<float>((value >> shift) & 255) / 255);
  };
  return {component(16), component(8), component(0)};
}

std::vector<SpectrumSample> parse_spectrum(std::string_view text, const Location& where) {
  std::vector<SpectrumSample> samples;
  for (const std::string_view word : split_list(text)) {
    const std::size_t colon = word.find(':');
    if (colon == std::string_view::npos) {
      fail(where, quoted(word) + " is not of the form wavelength:value");
    }
    samples.push_back(
        {parse_number(word.substr(0, colon), where), parse_number(word.substr(colon + 1), where)});
    if (samples.back().value < 0) fail(where, "negative value in a spectrum: " + quoted(word));
    if (samples.size() > 1 && samples.back().wavelength <= samples.end()[-2].wavelength) {
      fail(where, "wavelengths of a spectrum must increase; see " + quoted(word));
    }
  }
  if (samples.size() < 2) fail(where, "a spectrum needs at least two wavelength:value pairs");
  return samples;
}

Rgb non_negative(Rgb c) { return {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)}; }

float to_float(double value, const Location& where) {
  if (std::abs(value) > std::numeric_limits<float>::max()) fail(where, "a number is out of range");
  return static_cast<float>(value);
}

}  // namespace

double parse_number(std::string_view text, const Location& where) {
  const std::string_view digits = without_plus(trim(text));
  double value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error == std::errc::result_out_of_range) fail(where, quoted(text) + " is out of range");
  if (error != std::errc() || stop != end) fail(where, quoted(text) + " is not a number");
  if (!std::isfinite(value)) fail(where, quoted(text) + " is not a finite number");
  return value;
}

long long parse_integer(std::string_view text, const Location& where) {
  const std::string_view digits = without_plus(trim(text));
  long long value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error == std::errc::result_out_of_range) fail(where, quoted(text) + " is out of range");
  if (error != std::errc() || stop != end) fail(where, quoted(text) + " is not an integer");
  return value;
}

bool parse_boolean(std::string_view text, const Location& where) {
  const std::string_view word = trim(text);
  if (word == "true" || word == "false") return word == "true";
  fail(where, quoted(text) + " is neither 'true' nor 'false'");
}

std::vector<double> parse_numbers(std::string_view text, const Location& where) {
  std::vector<double> numbers;
  for (const std::string_view word : split_list(text)) numbers.push_back(parse_number(word, where));
  return numbers;
}

Vec3 parse_vector(const XmlNode& node) {
  const auto to_vec = [&](double x, double y, double z) {
    return Vec3{to_float(x, node.where), to_float(y, node.where), to_float(z, node.where)};
  };
  if (const std::string* value = node.attribute("value")) {
    const std::vector<double> n = parse_numbers(*value, node.where);
    if (n.size() != 3) fail(node.where, quoted(*value) + " does not have three numbers");
    return to_vec(n[0], n[1], n[2]);
  }
  const auto axis = [&](const char* name) {
    const std::string* text = node.attribute(name);
    return text ? parse_number(*text, node.where) : 0;
  };
  if (!node.attribute("x") && !node.attribute("y") && !node.attribute("z")) {
    fail(node.where, "<" + node.tag + "> needs 'value', or 'x', 'y' and 'z'");
  }
  return to_vec(axis("x"), axis("y"), axis("z"));
}

namespace {

/// The number of a nested <float name="...">, or `fallback`.
double nested_number(const XmlNode& node, const std::string& name, std::optional<double> fallback) {
  for (const XmlNode& child : node.children) {
    if (child.required("name") == name) return parse_number(child.required("value"), child.where);
  }
  if (!fallback) fail(node.where, "<" + node.tag + "> needs <float name=\"" + name + "\">");
  return *fallback;
}

Rgb parse_blackbody(const XmlNode& node, ColorRole role) {
  double temperature = 0, scale = 1;
  if (node.tag == "blackbody") {
    std::string text = node.required("temperature");
    if (!text.empty() && (text.back() == 'K' || text.back() == 'k')) text.pop_back();
    temperature = parse_number(text, node.where);
    if (const std::string* s = node.attribute("scale")) scale = parse_number(*s, node.where);
  } else {
    temperature = nested_number(node, "temperature", std::nullopt);
    scale = nested_number(node, "scale", 1);
  }
  if (role != ColorRole::emission) fail(node.where, "only emitters can be black bodies");
  if (!(temperature > 0)) fail(node.where, "the temperature of a black body must be above 0 K");
  if (!(scale >= 0)) fail(node.where, "the scale of a black body must not be negative");
  const Rgb c = blackbody_radiance(temperature) * static_cast<float>(scale);
  if (!is_finite(c)) fail(node.where, "a number is out of range");
  return c;
}

}  // namespace

Rgb parse_color(const XmlNode& node, ColorRole role) {
  if (node.tag == "blackbody") return parse_blackbody(node, role);
  if (const std::string* type = node.attribute("type")) {
    if (*type == "blackbody") return parse_blackbody(node, role);
    fail(node.where, unknown_name("spectrum plug-in", *type, {"blackbody"}));
  }
  const std::string& text = node.required("value");
  const Location& where = node.where;
  const std::string_view word = trim(text);
  if (!word.empty() && word[0] == '#') return parse_hex(word, where);
  if (node.tag == "spectrum" && word.find(':') != std::string_view::npos) {
    const bool emits = role == ColorRole::emission;
    return non_negative(spectrum_to_rgb(parse_spectrum(word, where),
                                        emits ? SpectrumKind::emissive : SpectrumKind::reflective));
  }
  const std::vector<double> n = parse_numbers(text, where);
  if (n.size() != 1 && n.size() != 3) fail(where, quoted(text) + " is not a colour");
  if (*std::min_element(n.begin(), n.end()) < 0) fail(where, "negative colour: " + quoted(text));
  const auto component = [&](std::size_t i) {
    const float value = to_float(n[n.size() == 1 ? 0 : i], where);
    return node.tag == "srgb" ? srgb_to_linear(value) : value;
  };
  return {component(0), component(1), component(2)};
}

}  // namespace octolux
