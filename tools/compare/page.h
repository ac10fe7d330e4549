// A web page on which pictures are compared: wipe, blink, side by side, zoom and pan in step,
// values under the cursor, exposure, tables of figures. One file that opens from disk without a
// server or a network: pictures as half floats, the view as a table (page/page.js has both
// formats), and the figures as the very JSON text that is written beside it. Opened with ?selftest
// it tests itself.
//
// For any program part that has pictures to compare: `compare` is one, see comparison_page.h.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/display.h"
#include "tools/compare/comparison.h"
#include "tools/compare/heat_map.h"

namespace octolux {

/// What all pictures of a page have in common: the size of the first.
struct PagePicture {
  std::string name;
  Image linear;  // shown through the page's view
};

/// Numbers in colours.
struct PageMap {
  std::string name;
  ScalarField field;
  bool diverging = true;  // ColourMap::diverging, else sequential
  double low = -1, high = 1;
  std::string unit;      // behind every number
  double unit_size = 1;  // a number is shown divided by this; 0.01 for per cent
  std::string caption;   // under the scale bar
};

/// Rows of figures. Cells are JSON pointers into Page::data, so that table and data cannot differ.
struct PageTable {
  struct Column {
    std::string title, formula;
    Better better = Better::neither;
  };
  struct Row {
    std::string name;
    std::vector<std::string> pointers;  // one per column; what is not there stays empty
  };
  std::vector<Column> columns;
  std::vector<Row> rows;
};

struct Page {
  std::string title;
  std::vector<std::string> notes;
  std::vector<PagePicture> pictures;
  std::vector<PageMap> maps;
  PageTable table;
  DisplayOptions display;  // its exposure is where the slider starts
  std::string data;        // JSON text
};

/// Pictures of more pixels than this are averaged down for the page, which says so.
inline constexpr double kPagePixels = 2.0e6;

/// The page's HTML. Throws Error as to_display.
std::string make_page(const Page& page);

/// Planes of one size as page.js reads them: half floats, differences along rows, bytes split,
/// zlib, base64. Beyond the range of a half: infinite.
std::string encode_planes(const std::vector<std::vector<float>>& planes, int width);

/// Bytes in base64 (RFC 4648).
std::string base64(const std::string& bytes);

/// The view as page.js reads it: {name, kind, size, offset, top, error, table}; 99 % of colours
/// are shown within `error` 255ths of OpenColorIO.
nlohmann::ordered_json view_table(const DisplayOptions& display);

}  // namespace octolux
