// Is the difference of two pictures more than their noise? Every value of the image is tested
// against the reference's by Welch's t-test (Welch 1947) with the variances both files carry, and
// the many tests are held together by Sidak's correction. A rejection means bias.
//
// The variances are of means over `passes` independent passes; without that number they count as
// exact and the test is a z-test. Values next to each other may share photons: dependence makes
// Sidak's correction cautious, never reckless. Thread-safe; deterministic.
#pragma once

#include <cstdint>

#include "tools/compare/layer_view.h"
#include "tools/compare/mask.h"

namespace octolux {

/// Probability that pictures which differ by nothing but noise are told apart.
inline constexpr double kNoiseAlpha = 1e-4;

struct NoiseTest {
  double alpha = kNoiseAlpha;
  double sidak_alpha = 0;        // of each single value
  std::int64_t tested = 0;       // values
  std::int64_t untested = 0;     // differ, but neither picture knows a variance there
  std::int64_t rejected = 0;     // p below sidak_alpha
  double largest = 0;            // the deviate with the smallest p, signed, x - y
  double smallest_p = 1;         // its p
  std::int64_t largest_at = -1;  // its pixel; -1: nothing was tested

  bool differ() const { return rejected > 0; }
};

/// At least one of the two has variances. Throws Error as check_comparable.
NoiseTest test_noise(const LayerView& reference, const LayerView& image, const Mask& mask = {},
                     double alpha = kNoiseAlpha);

}  // namespace octolux
