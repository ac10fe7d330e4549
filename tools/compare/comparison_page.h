// The page of `octolux compare`: reference, images, heat maps and figures.
#pragma once

#include "tools/compare/page.h"
#include "tools/compare/sheets.h"

namespace octolux {

/// Of the comparison's first layer; `json` is the text of its JSON file. Layers without R G B are
/// shown as heat maps alone.
Page comparison_page(const Comparison& comparison, const ComparedViews& views,
                     const DisplayOptions& display, double range, const std::string& json);

/// Columns for every figure that the first layer of any image has.
PageTable figure_table(const Comparison& comparison);

}  // namespace octolux
