// Quadrics: what shape.cpp asks of them beyond shape.h.
#pragma once

#include "core/shape.h"

namespace octolux {

/// Tight box, rounded outwards.
Bounds bounds(const Quadric& quadric);
/// [m^2], relative error below 1e-4.
double area(const Quadric& quadric);

}  // namespace octolux
