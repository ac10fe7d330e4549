// The view of a page (page.h) as a table, so that the page's exposure slider shows what
// OpenColorIO would: a curve per channel if channels do not mix, else a cube. How far the table is
// off is measured, halfway between its entries, where interpolation is worst.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tools/compare/page.h"

namespace octolux {
namespace {

// Entries lie evenly over log2(1 + v / kOffset), up to kTop: seven stops above 1, and nearly
// linear below 1/32.
constexpr double kOffset = 1.0 / 32;
constexpr double kTop = 128;
constexpr int kCurve = 4096;
constexpr int kCube = 49;

float light_at(double entry, int size) {
  const double span = std::log2(1 + kTop / kOffset);
  return static_cast<float>(kOffset * std::expm1(std::log(2) * span * entry / (size - 1)));
}

Image grey_ramp(int size) {
  Image ramp(size, 1);
  for (int i = 0; i < size; ++i) ramp.at(i, 0) = Rgb(light_at(i, size));
  return ramp;
}

/// What 99 % of the differences of all channels are below.
float usual_difference(const Image& p, const Image& q) {
  std::vector<float> sizes;
  for (std::size_t i = 0; i < p.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) sizes.push_back(std::abs(p.pixels[i][c] - q.pixels[i][c]));
  }
  const auto limit = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 99 / 100);
  std::nth_element(sizes.begin(), limit, sizes.end());
  return *limit;
}

/// Does the view treat each channel by itself? Looks at colours made of the ramp's lights.
bool is_curve(const Image& shown_ramp, const DisplayOptions& display) {
  constexpr int kColours = 256;
  Image colours(kColours, 1), expected(kColours, 1);
  for (int i = 0; i < kColours; ++i) {
    // Primes far apart spread the three over the ramp.
    const int r = i * 389 % kCurve, g = i * 1543 % kCurve, b = i * 6151 % kCurve;
    colours.at(i, 0) = {light_at(r, kCurve), light_at(g, kCurve), light_at(b, kCurve)};
    expected.at(i, 0) = {shown_ramp.at(r, 0).r, shown_ramp.at(g, 0).g, shown_ramp.at(b, 0).b};
  }
  constexpr float kInvisible = 0.25f / 255;
  return usual_difference(to_display(colours, display), expected) < kInvisible;
}

std::string bytes_of(const Image& shown) {
  std::string bytes;
  for (const Rgb& p : shown.pixels) {
    for (int c = 0; c < 3; ++c) {
      bytes.push_back(static_cast<char>(static_cast<unsigned char>(std::lround(255 * p[c]))));
    }
  }
  return bytes;
}

/// The colour of a cube's entry, or between entries.
Rgb cube_light(double r, double g, double b) {
  return {light_at(r, kCube), light_at(g, kCube), light_at(b, kCube)};
}

/// Red slowest, blue fastest.
Image cube() {
  Image image(kCube * kCube, kCube);
  for (int r = 0; r < kCube; ++r) {
    for (int i = 0; i < kCube * kCube; ++i) {
      image.at(i, r) = cube_light(r, std::div(i, kCube).quot, i % kCube);
    }
  }
  return image;
}

/// How far the middles of all cells are from the mean of their corners.
float cube_error(const Image& shown, const DisplayOptions& view) {
  constexpr int kCells = kCube - 1;
  Image middles(kCells * kCells, kCells), means(kCells * kCells, kCells);
  for (int r = 0; r < kCells; ++r) {
    for (int i = 0; i < kCells * kCells; ++i) {
      const int g = i / kCells, b = i % kCells;
      middles.at(i, r) = cube_light(r + 0.5, g + 0.5, b + 0.5);
      for (int corner = 0; corner < 8; ++corner) {
        const int at = (g + (corner >> 1 & 1)) * kCube + b + (corner & 1);
        means.at(i, r) += 0.125f * shown.at(at, r + (corner >> 2));
      }
    }
  }
  return usual_difference(to_display(middles, view), means);
}

float curve_error(const Image& shown, const DisplayOptions& view) {
  Image middles(kCurve - 1, 1), means(kCurve - 1, 1);
  for (int i = 0; i < kCurve - 1; ++i) {
    middles.at(i, 0) = Rgb(light_at(i + 0.5, kCurve));
    means.at(i, 0) = 0.5f * (shown.at(i, 0) + shown.at(i + 1, 0));
  }
  return usual_difference(to_display(middles, view), means);
}

}  // namespace

nlohmann::ordered_json view_table(const DisplayOptions& display) {
  DisplayOptions view = resolved(display);
  view.exposure = 0;  // the page's slider has it
  const Image ramp = to_display(grey_ramp(kCurve), view);
  const bool curve = is_curve(ramp, view);
  const Image shown = curve ? ramp : to_display(cube(), view);
  const float error = curve ? curve_error(shown, view) : cube_error(shown, view);
  // Bytes of the table and of the picture, and a half float's rounding, are another unit.
  return {{"name", view.display + ", " + view.view},
          {"kind", curve ? "curve" : "cube"},
          {"size", curve ? kCurve : kCube},
          {"offset", kOffset},
          {"top", kTop},
          {"error", std::ceil(255 * error) + 1},
          {"table", base64(bytes_of(shown))}};
}

}  // namespace octolux
