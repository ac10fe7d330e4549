// The sun in an environment map: the part of a picture that is far brighter than the rest and
// small. Taken out (take_out_sun in core/light.h), it is a light of its own: one that can be told
// from the sky where lights are chosen, and whose sharp shadows need no photons.
#pragma once

#include "core/image.h"

namespace octolux {

/// Solid angle [sr] from which a map in the layout of `envmap` sends light: of its cells, each
/// between four neighbouring texels, of which one has light.
double lit_solid_angle(const Image& map);

/// A light from no more than this [sr] is narrow: a disc of 4 degrees' radius. Maps of 128 columns
/// can still draw the sun so small.
inline constexpr double kNarrow = 0.015;

}  // namespace octolux
