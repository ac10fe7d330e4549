// What `octolux compare` draws: the pictures side by side, and heat maps of where each image is
// brighter or darker than the reference. All pictures of a sheet share view, exposure and range.
#pragma once

#include <optional>
#include <vector>

#include "core/display.h"
#include "tools/compare/comparison.h"
#include "tools/compare/heat_map.h"

namespace octolux {

/// The first layer of a comparison, as it was compared.
struct ComparedViews {
  LayerView reference;
  std::vector<LayerView> images;
};

/// One panel each for the reference and the images, with their main figures. Throws Error unless
/// the layer is R G B, and as to_display.
Image side_by_side_sheet(const Comparison& comparison, const ComparedViews& views,
                         const DisplayOptions& display);

/// One panel per image, signed relative difference (heat_map.h); colours span [-range, range].
Image heat_map_sheet(const Comparison& comparison, const ComparedViews& views, double range);

/// The relative differences of all images, in order.
std::vector<ScalarField> relative_differences(const ComparedViews& views);

}  // namespace octolux
