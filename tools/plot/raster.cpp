// drawing.h in pixels: edges are smoothed by the distance of a pixel's centre from them; words are
// those of compare/text.h.
#include <algorithm>
#include <cmath>

#include "tools/compare/text.h"
#include "tools/plot/drawing.h"

namespace octolux {
namespace {

Rgb paint_of(Ink ink) {
  constexpr float kFull = 255;
  return Rgb(static_cast<float>(ink.r) / kFull, static_cast<float>(ink.g) / kFull,
             static_cast<float>(ink.b) / kFull);
}

double distance_to_segment(Spot p, Spot a, Spot b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t =
      square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Distance of `p` from the line through two corners, positive to its left.
double side(Spot p, Spot a, Spot b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return (dx * (p.y - a.y) - dy * (p.x - a.x)) / std::hypot(dx, dy);
}

class Canvas {
 public:
  Canvas(const Drawing& drawing, int scale)
      : scale_(scale),
        image_(static_cast<int>(drawing.width * scale), static_cast<int>(drawing.height * scale)) {
    std::fill(image_.pixels.begin(), image_.pixels.end(), Rgb(1));
  }
  Image& image() { return image_; }

  void operator()(const Polyline& line) {
    double phase = 0;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      dashed(line, line.points[i], line.points[i + 1], phase);
    }
  }
  void operator()(const Polygon& polygon) {
    const std::vector<Spot> p = scaled(polygon.points);
    double area = 0;  // twice, signed
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Spot a = p[i], b = p[(i + 1) % p.size()];
      area += a.x * b.y - a.y * b.x;
    }
    const double sign = area < 0 ? -1 : 1;
    blend(p, 0, polygon.ink, [&](Spot at) {
      double inside = 1;
      for (std::size_t i = 0; i < p.size(); ++i) {
        inside = std::min(inside, 0.5 + sign * side(at, p[i], p[(i + 1) % p.size()]));
      }
      return inside;
    });
  }
  void operator()(const Words& words);

 private:
  std::vector<Spot> scaled(const std::vector<Spot>& points) const {
    std::vector<Spot> out;
    for (const Spot& p : points) out.push_back({p.x * scale_, p.y * scale_});
    return out;
  }

  /// Lays `ink` over every pixel near `points` as far as cover(its centre) says.
  template <class Cover>
  void blend(const std::vector<Spot>& points, double margin, Ink ink, Cover&& cover) {
    double left = image_.width, right = 0, top = image_.height, bottom = 0;
    for (const Spot& p : points) {
      left = std::min(left, p.x), right = std::max(right, p.x);
      top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    }
    const int x0 = std::max(0, static_cast<int>(left - margin - 1));
    const int x1 = std::min(image_.width - 1, static_cast<int>(right + margin + 1));
    const int y0 = std::max(0, static_cast<int>(top - margin - 1));
    const int y1 = std::min(image_.height - 1, static_cast<int>(bottom + margin + 1));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const auto alpha = static_cast<float>(std::clamp(cover({x + 0.5, y + 0.5}), 0.0, 1.0));
        image_.at(x, y) = image_.at(x, y) * (1 - alpha) + paint_of(ink) * alpha;
      }
    }
  }

  void segment(const Polyline& line, Spot a, Spot b) {
    const std::vector<Spot> ends = scaled({a, b});
    const double half = line.width * scale_ / 2;
    blend(ends, half, line.ink,
          [&](Spot at) { return 0.5 + half - distance_to_segment(at, ends[0], ends[1]); });
  }

  /// The parts of a segment that its dashes draw; `phase` is the length of line before it.
  void dashed(const Polyline& line, Spot a, Spot b, double& phase) {
    if (line.dashes.empty()) return segment(line, a, b);
    double period = 0;
    for (const double d : line.dashes) period += d;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const auto along = [&](double s) {
      return Spot{a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length};
    };
    double s = -std::fmod(phase, period);
    for (std::size_t i = 0; s < length; s += line.dashes[i % line.dashes.size()], ++i) {
      const double from = std::max(0.0, s);
      const double to = std::min(length, s + line.dashes[i % line.dashes.size()]);
      if (i % 2 == 0 && to > from) segment(line, along(from), along(to));
    }
    phase += length;
  }

  int scale_;
  Image image_;
};

void Canvas::operator()(const Words& words) {
  const auto mark = words.upward ? std::string::npos : words.text.find('^');
  const std::string plain = words.text.substr(0, mark);
  const std::string raised = mark == std::string::npos ? "" : words.text.substr(mark + 1);
  const int width = text_width(plain, scale_) + text_width(raised, scale_);
  const int height = line_height(scale_);
  const double shares[] = {0, 0.5, 1};
  const int before = static_cast<int>(shares[static_cast<int>(words.anchor)] * width);
  const int base = 9 * scale_;  // from the top of a line to its base line
  const int x = static_cast<int>(words.at.x * scale_), y = static_cast<int>(words.at.y * scale_);
  const TextStyle style{scale_, paint_of(words.ink)};
  if (!words.upward) {
    for (int shift = 0; shift <= (words.bold ? scale_ / 2 : 0); ++shift) {
      draw_text(image_, x - before + shift, y - base, plain, style);
      draw_text(image_, x - before + shift + text_width(plain, scale_),
                y - base - static_cast<int>(kRaise * scale_), raised, style);
    }
    return;
  }
  Image flat(width, height);
  std::fill(flat.pixels.begin(), flat.pixels.end(), Rgb(1));
  draw_text(flat, 0, 0, words.text, style);
  for (int i = 0; i < width; ++i) {
    for (int j = 0; j < height; ++j) {
      const int column = x - base + j, row = y + before - i;
      const bool inside = column >= 0 && column < image_.width && row >= 0 && row < image_.height;
      if (inside) image_.at(column, row) = flat.at(i, j);
    }
  }
}

}  // namespace

Image to_pixels(const Drawing& drawing, int scale) {
  Canvas canvas(drawing, scale);
  for (const auto& item : drawing.items) std::visit(canvas, item);
  return std::move(canvas.image());
}

}  // namespace octolux
