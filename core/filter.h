// Pixel reconstruction filters. A filter is sampled, not splatted: each eye sample belongs to one
// pixel and starts at an offset drawn from the filter, so pixels stay independent and per-pixel
// variance means something (Ernst et al. 2006). All our filters are positive, so weights are 1.
// Profiles are Mitsuba's; in two dimensions each is a product of two.
#pragma once

#include "core/vec.h"

namespace octolux {

struct Filter {
  enum class Kind { box, tent, gaussian };
  Kind kind = Kind::gaussian;
  float radius = 2;     // [pixels] of box (Mitsuba: 0.5) and tent (Mitsuba: 1)
  float stddev = 0.5f;  // [pixels] of the gaussian, which ends at 4 standard deviations

  /// Offset from the pixel's centre [pixels], distributed as the filter. u uniform in [0, 1)^2.
  Vec2 sample(Vec2 u) const;
};

}  // namespace octolux
