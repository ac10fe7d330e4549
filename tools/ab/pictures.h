// What `octolux ab` draws: the labelled A/B picture, the heat maps of leaks, the page. All pictures
// share view, exposure and range.
#pragma once

#include <string>

#include "core/display.h"
#include "tools/ab/result.h"
#include "tools/compare/page.h"

namespace octolux {

/// The range all leak heat maps share, in units of the reference's mean: what suits the middle one
/// of the pictures, so that a very bad one does not hide the others' faults.
double leak_range(const AbResult& result);

/// The reference and every picture with its main figures. Throws Error as to_display.
Image ab_sheet(const AbResult& result, const DisplayOptions& display);

/// One leak field per picture; colours span [-range, range].
Image leak_sheet(const AbResult& result, double range);

/// The page; `json` is the text of the JSON file.
Page ab_page(const AbResult& result, const DisplayOptions& display, double range,
             const std::string& json);

}  // namespace octolux
