// Pixel reconstruction filters. A filter is sampled, not splatted: each eye sample belongs to one
// pixel and starts at an offset drawn from the filter, so pixels stay independent and per-pixel
// variance means something (Ernst et al. 2006). All our filters are positive, so weights are 1.
#pragma once

#include <string>

#include "core/vec.h"

namespace octolux {

struct Filter {
  enum class Kind { box, tent, gaussian };
  Kind kind = Kind::gaussian;
  float radius = 2;     // [pixels]; box 0.5, tent 1, gaussian 4 standard deviations
  float stddev = 0.5f;  // [pixels] gaussian only

  /// Offset from the pixel's centre [pixels], distributed as the filter.
  Vec2 sample(Vec2 u) const;
};

}  // namespace octolux
