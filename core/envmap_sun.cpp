// envmap_sun.h.
#include "core/envmap_sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/light.h"

namespace octolux {
namespace {

using std::numbers::pi;

/// So many times as bright as the map's mean is far brighter than the rest.
constexpr double kFarBrighter = 100;
/// Of the light of the map; less is not worth a light of its own.
constexpr double kWorthwhile = 0.02;

/// [W m^-2 sr^-1]; 0 where it is no number that light can have.
double usable_luminance(Rgb c) {
  const bool usable = is_finite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0;
  return usable ? luminance(c) : 0;
}

/// Share of a map's directions, about, that a texel of this row stands for.
double texel_share(const Image& map, int row) {
  const double rows = std::max(1, map.height - 1);
  return pi / (2 * rows) * std::sin(pi * row / rows) / map.width;
}

double mean_luminance(const Image& map) {
  double sum = 0;
  for (int y = 0; y < map.height; ++y) {
    double row = 0;
    for (int x = 0; x < map.width; ++x) row += usable_luminance(map.at(x, y));
    sum += row * texel_share(map, y);
  }
  return sum;
}

}  // namespace

double lit_solid_angle(const Image& map) {
  const auto has_light = [&](int x, int y) {
    return max_component(map.at(x % map.width, std::min(y, map.height - 1))) > 0;
  };
  const int rows = std::max(1, map.height - 1);
  double sum = 0;
  for (int y = 0; y < rows; ++y) {
    int lit = 0;
    for (int x = 0; x < map.width; ++x) {
      lit +=
          has_light(x, y) || has_light(x + 1, y) || has_light(x, y + 1) || has_light(x + 1, y + 1);
    }
    sum += lit * (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows));
  }
  return sum * 2 * pi / map.width;
}

std::optional<Image> take_out_sun(Image& image) {
  const double mean = mean_luminance(image);
  const double most = kFarBrighter * mean;  // what is left of a texel
  Image sun(image.width, image.height);
  double taken = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double here = usable_luminance(image.at(x, y));
      if (!(here > most)) continue;
      sun.at(x, y) = image.at(x, y) * static_cast<float>(1 - most / here);
      taken += (here - most) * texel_share(image, y);
    }
  }
  if (!(taken > kWorthwhile * mean) || !(lit_solid_angle(sun) <= kNarrow)) return std::nullopt;
  // A map of nothing else is narrow as it is.
  if (lit_solid_angle(image) <= kNarrow) return std::nullopt;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (max_component(sun.pixels[i]) > 0) image.pixels[i] = image.pixels[i] - sun.pixels[i];
  }
  return sun;
}

}  // namespace octolux
