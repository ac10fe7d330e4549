// Separable filters of FLIP (flip.h) on planes of floats; beyond the border the outermost pixel
// goes on. Rows in parallel, each sum in one order: the same digits on any number of threads.
#pragma once

#include <vector>

namespace octolux::flip {

struct Plane {
  int width = 0, height = 0;
  std::vector<float> v;  // row-major

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), v(static_cast<std::size_t>(w) * h) {}
};

/// Weights at -radius .. radius.
using Kernel = std::vector<float>;

/// Each pixel the weighted sum of its row's (columns: its column's) neighbours.
Plane filter_rows(const Plane& plane, const Kernel& kernel);
Plane filter_columns(const Plane& plane, const Kernel& kernel);
/// The outer product of the two kernels.
Plane filter(const Plane& plane, const Kernel& along_row, const Kernel& along_column);

/// Weights of a kernel that is a sum of two Gaussians a sqrt(pi/b) exp(-pi^2 d^2 / b), d in
/// degrees: the eye's contrast sensitivity as a spatial filter (FLIP, section 4.1). Each Gaussian
/// is a separable kernel of sum 1, with the share it has of the whole.
struct ContrastFilter {
  Kernel first, second;  // second may be empty
  float first_share = 1, second_share = 0;

  Plane operator()(const Plane& plane) const;
};

enum class Opponent { achromatic, red_green, blue_yellow };
ContrastFilter contrast_filter(Opponent channel, double pixels_per_degree);

/// Gaussian and its derivatives for finding edges and points (FLIP, section 4.2): the Gaussian's
/// weights sum to 1, the derivatives' positive ones to 1 and negative ones to -1.
struct FeatureKernels {
  Kernel smooth, edge, point;
};
FeatureKernels feature_kernels(double pixels_per_degree);

}  // namespace octolux::flip
