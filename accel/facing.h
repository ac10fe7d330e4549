// Which way surfaces face, in 32 classes, so that whole branches of a tree can be passed over:
// under a ceiling that carries the photons of a sunlit roof on its other side, a look-up would else
// try thousands that do not count. The classes are the six ways of walls along the axes, and for
// all other surfaces the cells of the directions to the faces, edges and corners of a cube; a set
// of classes is a bit mask. Pure functions.
#pragma once

#include <cstdint>

#include "core/vec.h"

namespace octolux {

using FacingSet = std::uint32_t;
inline constexpr int kFacings = 32;

/// The one class of a surface with this unit normal.
FacingSet facing(Vec3 normal);

/// Every class with a normal that is within acos(`kFacingCosine`) of this one. May hold more.
FacingSet facing_near(Vec3 normal);
inline constexpr float kFacingCosine = 0.7f;

/// Every class with a normal that is more than acos(`kFacingCosine`) away from this one and from
/// its opposite. May hold more.
FacingSet facing_across(Vec3 normal);

}  // namespace octolux
