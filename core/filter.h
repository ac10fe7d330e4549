// Pixel reconstruction filters. Profiles are Mitsuba's; in two dimensions each is a product of two.
// Every eye sample counts in all pixels its filter reaches, which for the wider filters is worth
// two to three times as many samples. Box, tent and gaussian are positive; the others sharpen, and
// draw dark rims around what is bright.
#pragma once

namespace octolux {

struct Filter {
  enum class Kind { box, tent, gaussian, mitchell, lanczos };
  Kind kind = Kind::gaussian;
  float radius = 2;     // [pixels], half of the filter's width; for lanczos its number of lobes
  float stddev = 0.5f;  // [pixels] of the gaussian, which ends at 4 standard deviations
  // Of the cubics, whose radius is 2 (Mitchell & Netravali, "Reconstruction Filters in Computer
  // Graphics", 1988); b = 0 and c = 1/2 is Catmull & Rom's.
  float b = 1.0f / 3, c = 1.0f / 3;

  /// Half of the filter's width [pixels].
  float reach() const { return kind == Kind::gaussian ? 4 * stddev : radius; }

  /// Weight, not normalised, of a sample at distance `x` [pixels] from a pixel's centre along one
  /// axis. The box is half open, so that samples on its border belong to one pixel.
  float profile(float x) const;
};

}  // namespace octolux
