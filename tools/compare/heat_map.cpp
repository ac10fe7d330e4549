// heat_map.h.
#include "tools/compare/heat_map.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "tools/compare/metrics.h"

namespace octolux {
namespace {

constexpr std::int64_t kChunk = 1 << 14;  // pixels
constexpr double kWithinRange = 0.99;

template <class Pixel>
struct Grid {
  int width, height;
  const std::vector<Pixel>& pixels;
};

/// The mean of the square at (x, y) of a grid shrunk by `factor`.
template <class Pixel>
Pixel square_mean(const Grid<Pixel>& grid, int x, int y, int factor) {
  const int right = std::min(grid.width, (x + 1) * factor);
  const int bottom = std::min(grid.height, (y + 1) * factor);
  Pixel sum{};
  for (int row = y * factor; row < bottom; ++row) {
    for (int column = x * factor; column < right; ++column) {
      sum += grid.pixels[static_cast<std::size_t>(row) * grid.width + column];
    }
  }
  return sum / static_cast<float>((right - x * factor) * (bottom - y * factor));
}

int divided(int length, int factor) { return (length + factor - 1) / factor; }

template <class Pixel>
void shrink_into(std::vector<Pixel>& result, const Grid<Pixel>& grid, int factor) {
  const int width = divided(grid.width, factor);
  result.resize(static_cast<std::size_t>(width) * divided(grid.height, factor));
  parallel_for_chunks(static_cast<std::int64_t>(result.size()), kChunk,
                      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                        for (std::int64_t i = begin; i < end; ++i) {
                          result[i] = square_mean(grid, static_cast<int>(i % width),
                                                  static_cast<int>(i / width), factor);
                        }
                      });
}

}  // namespace

ScalarField relative_difference(const LayerView& reference, const LayerView& image) {
  ScalarField field{reference.width, reference.height, {}};
  field.values.resize(reference.pixels());
  parallel_for_chunks(
      static_cast<std::int64_t>(field.values.size()), kChunk,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          const float x = grey(image, static_cast<std::size_t>(i));
          const float y = grey(reference, static_cast<std::size_t>(i));
          const float d = (x - y) / std::sqrt(y * y + static_cast<float>(kMetricEpsilon));
          field.values[i] = std::isfinite(d) ? d : std::numeric_limits<float>::quiet_NaN();
        }
      });
  return field;
}

double heat_map_range(std::span<const ScalarField> fields) {
  std::vector<float> sizes;
  for (const ScalarField& field : fields) {
    for (const float v : field.values) {
      if (std::isfinite(v)) sizes.push_back(std::abs(v));
    }
  }
  if (sizes.empty()) return 1;
  const auto place = static_cast<std::ptrdiff_t>(kWithinRange * static_cast<double>(sizes.size()));
  const auto limit = sizes.begin() + std::min(place, std::ptrdiff_t(sizes.size()) - 1);
  std::nth_element(sizes.begin(), limit, sizes.end());
  for (double decade = 0.001; decade < 10; decade *= 10) {
    for (const double step : {1, 2, 5}) {
      if (static_cast<double>(*limit) <= step * decade) return step * decade;
    }
  }
  return 10;
}

Image colour_field(const ScalarField& field, const ColourMap& map, double low, double high) {
  Image image(field.width, field.height);
  const auto scale = static_cast<float>(1 / (high - low)), start = static_cast<float>(low);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float v = field.values[i];
    image.pixels[i] = std::isfinite(v) ? map((v - start) * scale) : kNotANumberColour;
  }
  return image;
}

Image shrink(const Image& image, int factor) {
  Image result;
  result.width = divided(image.width, factor);
  result.height = divided(image.height, factor);
  shrink_into(result.pixels, Grid<Rgb>{image.width, image.height, image.pixels}, factor);
  return result;
}

ScalarField shrink(const ScalarField& field, int factor) {
  ScalarField result{divided(field.width, factor), divided(field.height, factor), {}};
  shrink_into(result.values, Grid<float>{field.width, field.height, field.values}, factor);
  return result;
}

Image enlarge(const Image& image, int factor) {
  Image result(image.width * factor, image.height * factor);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) result.at(x, y) = image.at(x / factor, y / factor);
  }
  return result;
}

int shrink_factor(int width, int height, double pixels) {
  int factor = 1;
  while (static_cast<double>(divided(width, factor)) * divided(height, factor) > pixels) ++factor;
  return factor;
}

}  // namespace octolux
