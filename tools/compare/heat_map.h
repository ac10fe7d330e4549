// The signed relative difference of two pictures, (x - y) / sqrt(y^2 + 0.01) of their luminance:
// its square is what relMSE averages. Above 0 the image is too bright (light leaks), below too dark
// (shadow leaks). And what pictures of it need: a range all share, colours, smaller copies.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "tools/compare/colour_map.h"
#include "tools/compare/layer_view.h"

namespace octolux {

/// One number per pixel.
struct ScalarField {
  int width = 0, height = 0;
  std::vector<float> values;  // row-major
};

/// NaN where either picture is not finite.
ScalarField relative_difference(const LayerView& reference, const LayerView& image);

/// The least of 1, 2 or 5 times a power of ten, from 0.001 to 10, that 99 % of all values of all
/// fields lie within, by magnitude.
double heat_map_range(std::span<const ScalarField> fields);

/// Values from `low` to `high` in the map's colours (sRGB); what is not finite in
/// kNotANumberColour.
Image colour_field(const ScalarField& field, const ColourMap& map, double low, double high);

/// Averages squares of `factor` pixels; the last ones of rows and columns may be smaller.
Image shrink(const Image& image, int factor);
ScalarField shrink(const ScalarField& field, int factor);
/// Repeats every pixel.
Image enlarge(const Image& image, int factor);

/// The least factor that shrinks a picture of this size to at most `pixels` pixels.
int shrink_factor(int width, int height, double pixels);

}  // namespace octolux
