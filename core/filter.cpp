// filter.h.
#include "core/filter.h"

#include <algorithm>
#include <cmath>

namespace octolux {

float Filter::profile(float x) const {
  if (kind == Kind::box) return x >= -radius && x < radius ? 1.0f : 0.0f;
  if (kind == Kind::tent) return std::max(0.0f, 1 - std::abs(x) / radius);
  const float s = x / stddev;
  return std::max(0.0f, std::exp(-0.5f * s * s) - std::exp(-8.0f));
}

}  // namespace octolux
