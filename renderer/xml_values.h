// Values of a scene file: numbers, points, colours, transforms. Parsing is strict (the whole text
// must be the value) and locale-independent; NaN and infinity are refused. All throw Error with
// the file and line of the node.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/affine.h"
#include "core/rgb.h"
#include "core/vec.h"
#include "renderer/xml_document.h"

namespace octolux {

double parse_number(std::string_view text, const Location& where);
long long parse_integer(std::string_view text, const Location& where);
bool parse_boolean(std::string_view text, const Location& where);
/// Numbers separated by commas, spaces or both.
std::vector<double> parse_numbers(std::string_view text, const Location& where);

/// <point> or <vector>: value="x, y, z", or attributes x, y, z (0 if absent).
Vec3 parse_vector(const XmlNode& node);

/// What a colour stands for; decides how wavelength lists become RGB.
enum class ColorRole {
  reflectance,  // seen under D65
  emission,     // as it is
  ior,          // eta and k: as reflectance, but any size
};
/// <rgb>, <srgb>, <color>, <spectrum> or <float>: one number, three, "#rrggbb" (sRGB), or
/// "wavelength:value, ..."; or a black body: 0.6's <blackbody temperature=>, 3's <spectrum
/// type="blackbody"> around <float name="temperature">. Negative numbers are an Error; components
/// of a spectrum outside Rec.709 become 0.
Rgb parse_color(const XmlNode& node, ColorRole role);

/// <transform>: its elements in order, each applied after those above it.
Affine parse_transform(const XmlNode& node);

}  // namespace octolux
