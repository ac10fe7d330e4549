// filter.h.
#include "core/filter.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace octolux {

namespace {

float gaussian(float x, float stddev) {
  const float s = x / stddev;
  return std::max(0.0f, std::exp(-0.5f * s * s) - std::exp(-8.0f));
}

/// Mitchell & Netravali's cubics, x >= 0.
float cubic(float x, float b, float c) {
  if (x >= 2) return 0;
  const float rest = 2 - x;
  if (x >= 1) return rest * rest * (rest * b / 6 - (x - 1) * c);
  return ((6 - 2 * b) + x * x * ((-18 + 12 * b + 6 * c) + x * (12 - 9 * b - 6 * c))) / 6;
}

float sinc(float x) {
  const float angle = kPi * x;
  return std::abs(angle) < 1e-4f ? 1 : std::sin(angle) / angle;
}

}  // namespace

float Filter::profile(float x) const {
  const float distance = std::abs(x);
  switch (kind) {
    case Kind::box:
      return x >= -radius && x < radius ? 1.0f : 0.0f;
    case Kind::tent:
      return std::max(0.0f, 1 - distance / radius);
    case Kind::gaussian:
      return gaussian(x, stddev);
    case Kind::mitchell:
      return cubic(distance, b, c);
    case Kind::lanczos:
      return distance < radius ? sinc(x) * sinc(x / radius) : 0.0f;
  }
  return 0;
}

}  // namespace octolux
