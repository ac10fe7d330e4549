// The files of `octolux ab` beside the renders themselves: sheets, masks, figures, page.
#pragma once

#include <string>
#include <vector>

#include "core/display.h"
#include "tools/ab/result.h"

namespace octolux {

/// Names of those that are always there.
std::vector<std::string> result_files();

/// Leak heat maps span [-range, range]. Throws Error if a file cannot be written, and as
/// to_display.
void write_results(const AbResult& result, const std::string& folder, const DisplayOptions& display,
                   double range);

}  // namespace octolux
