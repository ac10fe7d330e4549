// The curve of one variant: its error after each doubling of time, split into bias and noise with
// the help of several seeds.
//
// All measures are relative, DESIGN's relMSE: mean over pixels and channels of w (x - y)^2 with
// w = 1/(y^2 + 0.01). With pictures x_1 ... x_R of R seeds of one pass count,
//   relMSE   = mean over r of mean w (x_r - y)^2
//   noise^2  = mean w s^2,  s^2 the variance of the x_r (R = 1: their own layer `variance`)
//   floor    = mean w v,    v the reference's variance
//   error^2  = relMSE - floor
//   bias^2   = relMSE - floor - noise^2, its standard error by leaving out one seed after the other
// so error^2 = bias^2 + noise^2. As estimates, error^2 and bias^2 may come out below 0.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/compare/layer_view.h"

namespace octolux {

/// A picture on disk, and what it took.
struct TimedPicture {
  std::string file;
  double seconds = 0;
  int passes = 0;  // 0: not known
};

/// One point of a curve from one seed.
struct SeedPoint {
  std::string file;
  double seconds = 0;
  double rel_mse = 0, trimmed_rel_mse = 0;
  double mean_ratio = 0;
};

struct SeriesPoint {
  int passes = 0;
  std::vector<SeedPoint> seeds;
  double seconds = 0;                     // mean
  double rel_mse = 0, rel_mse_error = 0;  // mean, and its standard error; NaN: one seed only
  double trimmed_rel_mse = 0;             // without the worst 0.1 % of pixels
  double mean_ratio = 0;                  // brightness, mean x / mean y
  double floor = 0;                       // of the reference; 0 if its variance is not known
  std::optional<double> noise2, bias2, bias2_error;  // where they can be told
  std::int64_t non_finite = 0;                       // pixels left out

  double error() const;  // sqrt(max(0, relMSE - floor))
};

struct Series {
  std::string name;
  bool external = false;
  std::vector<SeriesPoint> points;  // by time
};

/// The pictures of one point, one of each seed. Throws Error naming the file that does not fit the
/// reference.
SeriesPoint measure_point(const NamedPicture& reference, const std::vector<TimedPicture>& pictures);

}  // namespace octolux
