// Colours for numbers, perceptually uniform and safe for the colour-blind: straight lines in CIELAB
// at constant steps, along which equal steps look equally large (CIE76), between blue and the warm
// side, which people without red or green cones tell apart as well. The idea of the sequential map
// is cividis (Nunez, Anderton & Renslow 2018), of the diverging one Moreland (2009); the colours
// are computed. Thread-safe.
#pragma once

#include <vector>

#include "core/rgb.h"

namespace octolux {

class ColourMap {
 public:
  static constexpr int kSize = 255;  // odd, so that the middle has a colour of its own

  /// The colour (sRGB, [0, 1]) at t in [0, 1]; beyond, that of the end.
  Rgb operator()(float t) const;
  /// All colours, from 0 to 1.
  const std::vector<Rgb>& colours() const { return colours_; }

  /// Blue (t = 0), nearly white in the middle, orange-brown (t = 1); both ends equally dark.
  static ColourMap diverging();
  /// Dark blue to light yellow, ever lighter.
  static ColourMap sequential();

 private:
  std::vector<Rgb> colours_;
};

/// What stands where a number is not finite: in no map.
inline constexpr Rgb kNotANumberColour{1, 0, 1};

}  // namespace octolux
