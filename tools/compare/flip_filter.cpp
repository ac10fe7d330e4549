// flip_filter.h.
#include "tools/compare/flip_filter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/parallel.h"

namespace octolux::flip {
namespace {

constexpr std::int64_t kRowsPerChunk = 16;
constexpr double kPi = std::numbers::pi;

/// Calls body(y) for every row.
template <class Body>
void for_rows(int height, const Body& body) {
  parallel_for_chunks(height, kRowsPerChunk,
                      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                        for (std::int64_t y = begin; y < end; ++y) body(static_cast<int>(y));
                      });
}

/// to[i] += weight * from[i].
void add_scaled(float* to, const float* from, float weight, int count) {
  for (int i = 0; i < count; ++i) to[i] += weight * from[i];
}

const float* row(const Plane& plane, int y) {
  return plane.v.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(plane.width);
}
float* row(Plane& plane, int y) {
  return plane.v.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(plane.width);
}

int radius_of(const Kernel& kernel) { return static_cast<int>(kernel.size()) / 2; }

/// One Gaussian of the contrast sensitivity function; `sum` receives what it weighs in two
/// dimensions before it is scaled to sum 1.
struct Gaussian {
  double a, b;

  Kernel kernel(int radius, double pixels_per_degree, double& sum) const {
    std::vector<double> w;
    double total = 0;
    for (int i = -radius; i <= radius; ++i) {
      const double d = i / pixels_per_degree;
      w.push_back(std::exp(-kPi * kPi * d * d / b));
      total += w.back();
    }
    sum = a * std::sqrt(kPi / b) * total * total;
    Kernel kernel;
    for (const double weight : w) kernel.push_back(static_cast<float>(weight / total));
    return kernel;
  }
};

/// Scaled so that positive weights sum to 1, and negative ones, if any, to -1.
Kernel balanced(const std::vector<double>& weights) {
  double positive = 0, negative = 0;
  for (const double w : weights) (w > 0 ? positive : negative) += std::abs(w);
  Kernel kernel;
  for (const double w : weights) {
    kernel.push_back(static_cast<float>(w > 0 ? w / positive : w < 0 ? w / negative : 0));
  }
  return kernel;
}

}  // namespace

Plane filter_rows(const Plane& plane, const Kernel& kernel) {
  Plane result(plane.width, plane.height);
  const int radius = radius_of(kernel);
  for_rows(plane.height, [&](int y) {
    const float* from = row(plane, y);
    std::vector<float> padded(static_cast<std::size_t>(plane.width) + kernel.size() - 1, *from);
    std::copy(from, from + plane.width, padded.begin() + radius);
    std::fill(padded.end() - radius, padded.end(), from[plane.width - 1]);
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      add_scaled(row(result, y), padded.data() + k, kernel[k], plane.width);
    }
  });
  return result;
}

Plane filter_columns(const Plane& plane, const Kernel& kernel) {
  Plane result(plane.width, plane.height);
  const int radius = radius_of(kernel);
  for_rows(plane.height, [&](int y) {
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const int source = std::clamp(y + static_cast<int>(k) - radius, 0, plane.height - 1);
      add_scaled(row(result, y), row(plane, source), kernel[k], plane.width);
    }
  });
  return result;
}

Plane filter(const Plane& plane, const Kernel& along_row, const Kernel& along_column) {
  return filter_columns(filter_rows(plane, along_row), along_column);
}

Plane ContrastFilter::operator()(const Plane& plane) const {
  Plane result = filter(plane, first, first);
  if (second.empty()) return result;
  const Plane other = filter(plane, second, second);
  for_rows(plane.height, [&](int y) {
    float* to = row(result, y);
    const float* from = row(other, y);
    for (int x = 0; x < plane.width; ++x) to[x] = first_share * to[x] + second_share * from[x];
  });
  return result;
}

ContrastFilter contrast_filter(Opponent channel, double pixels_per_degree) {
  // All three have the radius of the widest Gaussian, 3 standard deviations of b = 0.04.
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * pixels_per_degree));
  double sum_1 = 0, sum_2 = 0;
  if (channel != Opponent::blue_yellow) {
    const Gaussian g{1, channel == Opponent::achromatic ? 0.0047 : 0.0053};
    return {g.kernel(radius, pixels_per_degree, sum_1), {}};
  }
  const Gaussian g1{34.1, 0.04}, g2{13.5, 0.025};
  ContrastFilter filter{g1.kernel(radius, pixels_per_degree, sum_1),
                        g2.kernel(radius, pixels_per_degree, sum_2)};
  filter.first_share = static_cast<float>(sum_1 / (sum_1 + sum_2));
  filter.second_share = static_cast<float>(sum_2 / (sum_1 + sum_2));
  return filter;
}

FeatureKernels feature_kernels(double pixels_per_degree) {
  constexpr double kPeakToTrough = 0.082;  // [degrees] of the eye's edge detector: 2 deviations
  const double deviation = 0.5 * kPeakToTrough * pixels_per_degree;  // [pixels]
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> smooth, edge, point;
  for (int x = -radius; x <= radius; ++x) {
    const double s = x / deviation, g = std::exp(-s * s / 2);
    smooth.push_back(g);
    edge.push_back(-x * g);
    point.push_back((s * s - 1) * g);
  }
  return {balanced(smooth), balanced(edge), balanced(point)};
}

}  // namespace octolux::flip
