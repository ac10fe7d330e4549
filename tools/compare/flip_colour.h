// The colour spaces of FLIP (flip.h): linear Rec.709, CIE XYZ, the linear opponent space YCxCz in
// which the eye's contrast sensitivity is modelled, and CIELAB with Hunt's adjustment. White is
// D65: what (1, 1, 1) gives.
#pragma once

namespace octolux::flip {

struct Triple {
  float a = 0, b = 0, c = 0;
};

/// IEC 61966-2-1, of a value in [0, 1].
float srgb_to_linear(float v);
float linear_to_srgb(float v);

/// YCxCz: Y = 116 Y/Yn - 16, Cx = 500 (X/Xn - Y/Yn), Cz = 200 (Y/Yn - Z/Zn).
Triple linear_to_opponent(Triple rgb);
/// Its inverse.
Triple opponent_to_linear(Triple ycxcz);
/// CIELAB with a* and b* scaled by L*/100, since colourfulness falls with luminance (Hunt 1952).
Triple linear_to_hunt_lab(Triple rgb);
/// Lightness difference plus distance in chroma (Abasi et al. 2020).
float hyab(Triple lab_1, Triple lab_2);
/// FLIP's colour difference in [0, 1]: HyAB to the power 0.7, of which the first 40 % of the
/// largest (green against blue) fill [0, 0.95].
float colour_error(float hyab_distance);

}  // namespace octolux::flip
