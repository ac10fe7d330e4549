// Pixel reconstruction filters. Profiles are Mitsuba's; in two dimensions each is a product of two.
// Every eye sample counts in all pixels its filter reaches, which for the wider filters is worth
// two to three times as many samples. All our filters are positive.
#pragma once

namespace octolux {

struct Filter {
  enum class Kind { box, tent, gaussian };
  Kind kind = Kind::gaussian;
  float radius = 2;     // [pixels] of box (Mitsuba: 0.5) and tent (Mitsuba: 1)
  float stddev = 0.5f;  // [pixels] of the gaussian, which ends at 4 standard deviations

  /// Half of the filter's width [pixels].
  float reach() const { return kind == Kind::gaussian ? 4 * stddev : radius; }

  /// Weight, not normalised, of a sample at distance `x` [pixels] from a pixel's centre along one
  /// axis. The box is half open, so that samples on its border belong to one pixel.
  float profile(float x) const;
};

}  // namespace octolux
