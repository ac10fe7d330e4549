// Time against size as a grid of log-log panels.
#pragma once

#include <string>
#include <vector>

#include "tools/bench/scaling/sweep.h"
#include "tools/plot/drawing.h"

namespace octolux {

/// Of those that have steps.
Drawing draw(const std::vector<ScalingCurve>& curves);

}  // namespace octolux
