// sheet.h.
#include "tools/compare/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "tools/compare/heat_map.h"
#include "tools/compare/text.h"

namespace octolux {
namespace {

constexpr int kMargin = 12;     // pixels
constexpr int kSmallest = 320;  // width a panel is enlarged to
constexpr int kWidest = 3200;   // of a sheet, unless one panel is wider
constexpr int kBarHeight = 20;
constexpr int kBarWidth = 600;
constexpr int kTicks = 5;
constexpr Rgb kPaper{1, 1, 1};

struct Layout {
  int zoom, columns, rows;
  int picture_width, picture_height;
  int cell_width, cell_height;
  int text_scale;
};

int text_lines(const std::vector<Panel>& panels) {
  std::size_t most = 0;
  for (const Panel& panel : panels) most = std::max(most, panel.remarks.size());
  return static_cast<int>(most);
}

Layout lay_out(const std::vector<Panel>& panels, SheetShape shape) {
  const Image& first = panels.front().shown;
  Layout l{};
  l.zoom = std::max(1, (kSmallest + first.width - 1) / first.width);
  l.picture_width = l.zoom * first.width;
  l.picture_height = l.zoom * first.height;
  l.text_scale = l.picture_width < 640 ? 1 : 2;
  l.cell_width = l.picture_width + kMargin;
  l.cell_height =
      l.picture_height + (1 + text_lines(panels)) * line_height(l.text_scale) + 2 * kMargin;
  const auto count = static_cast<int>(panels.size());
  int widest = std::max(1, kWidest / l.cell_width);  // columns
  if (shape == SheetShape::square) {
    widest = std::min(widest, static_cast<int>(std::ceil(std::sqrt(count))));
  }
  l.rows = (count + widest - 1) / widest;
  l.columns = (count + l.rows - 1) / l.rows;
  return l;
}

void paste(Image& sheet, const Image& picture, int x, int y) {
  for (int row = 0; row < picture.height; ++row) {
    const auto from = picture.pixels.begin() + std::ptrdiff_t{row} * picture.width;
    std::copy(from, from + picture.width, &sheet.at(x, y + row));
  }
}

void draw_panel(Image& sheet, const Panel& panel, const Layout& l, int x, int y) {
  const TextStyle style{l.text_scale};
  const auto write = [&](const std::string& line) {
    draw_text(sheet, x, y, fit_text(line, l.picture_width, l.text_scale), style);
    y += line_height(l.text_scale);
  };
  write(panel.title);
  paste(sheet, l.zoom == 1 ? panel.shown : enlarge(panel.shown, l.zoom), x, y);
  y += l.picture_height + kMargin / 2;
  for (const std::string& remark : panel.remarks) write(remark);
}

int bar_width(const Image& sheet) { return std::min(kBarWidth, sheet.width - 8 * kMargin); }

int bar_space(int scale) { return kBarHeight + 2 * line_height(scale) + 2 * kMargin; }

void draw_scale(Image& sheet, const ScaleBar& bar, int y, int scale) {
  const TextStyle style{scale};
  const int width = bar_width(sheet), left = 4 * kMargin;
  for (int i = 0; i < width; ++i) {
    const Rgb colour = bar.map(static_cast<float>(i) / static_cast<float>(width - 1));
    for (int row = 0; row < kBarHeight; ++row) sheet.at(left + i, y + row) = colour;
  }
  for (int tick = 0; tick < kTicks; ++tick) {
    const double t = static_cast<double>(tick) / (kTicks - 1);
    const double value = (bar.low + t * (bar.high - bar.low)) / bar.unit_size;
    const std::string label = bar.low < 0 && value != 0 ? fmt::format("{:+.3g}{}", value, bar.unit)
                                                        : fmt::format("{:.3g}{}", value, bar.unit);
    const int x = left + static_cast<int>(std::lround(t * (width - 1)));
    for (int row = kBarHeight; row < kBarHeight + 4; ++row) sheet.at(x, y + row) = Rgb(0);
    draw_text(sheet, x - text_width(label, scale) / 2, y + kBarHeight + 6, label, style);
  }
  const int line = y + kBarHeight + 6 + line_height(scale);
  draw_text(sheet, kMargin, line, fit_text(bar.caption, sheet.width - 2 * kMargin, scale), style);
}

}  // namespace

Image make_sheet(const std::string& title, const std::vector<Panel>& panels,
                 const std::optional<ScaleBar>& scale, SheetShape shape) {
  OCTOLUX_CHECK(!panels.empty());
  const Layout l = lay_out(panels, shape);
  const int top = kMargin + line_height(l.text_scale) + kMargin / 2;
  Image sheet(kMargin + l.columns * l.cell_width,
              top + l.rows * l.cell_height + (scale ? bar_space(l.text_scale) : 0));
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), kPaper);
  draw_text(sheet, kMargin, kMargin, fit_text(title, sheet.width - 2 * kMargin, l.text_scale),
            {l.text_scale});
  for (std::size_t i = 0; i < panels.size(); ++i) {
    OCTOLUX_CHECK(panels[i].shown.width == panels.front().shown.width &&
                  panels[i].shown.height == panels.front().shown.height);
    const int column = static_cast<int>(i) % l.columns, row = static_cast<int>(i) / l.columns;
    draw_panel(sheet, panels[i], l, kMargin + column * l.cell_width, top + row * l.cell_height);
  }
  if (scale) draw_scale(sheet, *scale, top + l.rows * l.cell_height, l.text_scale);
  return sheet;
}

}  // namespace octolux
