// FLIP: the difference a person perceives when alternating between two pictures, per pixel in
// [0, 1]. LDR-FLIP: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", Proc. ACM CGIT 3(2), 2020. HDR-FLIP: the largest
// LDR-FLIP over a range of exposures; Andersson, Nilsson, Shirley, Akenine-Moller, "Visualizing
// Errors in Rendered High Dynamic Range Images", Eurographics 2021 Short Papers.
//
// NaN counts as 0, as on a display. Thread-safe; the same digits on any number of threads.
#pragma once

#include <vector>

#include "core/image.h"
#include "tools/compare/mask.h"

namespace octolux {

/// A screen 0.7 m wide of 3840 pixels, 0.7 m away.
inline constexpr double kFlipPixelsPerDegree = 3840 * 3.14159265358979323846 / 180;

struct FlipMap {
  int width = 0, height = 0;
  std::vector<float> error;  // row-major

  /// Over the pixels that count.
  double mean(const Mask& mask = {}) const;
};

/// Exposures of HDR-FLIP [stops], evenly spaced from start to stop.
struct FlipExposures {
  double start = 0, stop = 0;
  int count = 1;
};

/// Of two pictures of one size as a display shows them: sRGB values in [0, 1].
FlipMap ldr_flip(const Image& reference, const Image& image,
                 double pixels_per_degree = kFlipPixelsPerDegree);

/// The exposures that bring the reference's brightest and its median luminance to 0.85 in the tone
/// mapper (Narkowicz's fit of ACES). Where the median is 0, the median of what is brighter is
/// taken; a black picture has the one exposure 0.
FlipExposures flip_exposures(const Image& reference);

/// Number of exposures for a range: one a stop, two at least.
int flip_exposure_count(double start, double stop);

/// Of two scene-linear pictures of one size.
FlipMap hdr_flip(const Image& reference, const Image& image,
                 double pixels_per_degree = kFlipPixelsPerDegree);
FlipMap hdr_flip(const Image& reference, const Image& image, const FlipExposures& exposures,
                 double pixels_per_degree);

}  // namespace octolux
