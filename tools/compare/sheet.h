// Labelled pictures on one sheet, for a PNG that explains itself: panels with title and remarks,
// and under them a scale bar with numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "tools/compare/colour_map.h"

namespace octolux {

struct Panel {
  std::string title;
  Image shown;                       // display values in [0, 1]
  std::vector<std::string> remarks;  // lines under the picture
};

struct ScaleBar {
  ColourMap map;
  double low = 0, high = 1;
  std::string unit;      // behind every number
  double unit_size = 1;  // a number is shown divided by this; 0.01 for per cent
  std::string caption;
};

/// How panels of one size stand: in as few rows as a screen's width allows, or as nearly as many
/// rows as columns, which reads better on a page of text.
enum class SheetShape { wide, square };

/// Panels of one size, left to right, row by row.
/// Small pictures are enlarged by a whole number; text that would not fit is cut.
Image make_sheet(const std::string& title, const std::vector<Panel>& panels,
                 const std::optional<ScaleBar>& scale = {}, SheetShape shape = SheetShape::wide);

}  // namespace octolux
