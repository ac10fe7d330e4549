// A quantity that grows step by step, and what each step took: measured, printed line by line,
// written as CSV.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace octolux {

/// What is measured at every step. Those in seconds are plotted, and have slopes.
struct Quantity {
  std::string name;
  std::string unit;

  bool is_time() const { return unit == "s"; }
};

struct ScalingStep {
  double size = 0;             // as it came out, e.g. photons really stored
  std::vector<double> values;  // one per quantity
};

struct Sweep {
  std::string name;   // as --only takes it
  std::string title;  // of the plot
  std::string unit;   // of the size
  std::vector<Quantity> quantities;
  std::vector<double> sizes;  // that are wanted, rising
  double ideal_slope = 1;     // of time against size in log-log
  std::function<ScalingStep(double size)> measure;
  /// Memory [bytes] that a step needs at its peak; none: hardly any.
  std::function<double(double size)> memory = {};
};

/// A sweep and its steps so far.
struct ScalingCurve {
  Sweep sweep;
  std::vector<ScalingStep> steps;

  /// Of a quantity between step `i` and the one before, in log-log.
  double slope(std::size_t quantity, std::size_t i) const;
  /// Least squares in log-log over the last decade, at least the last two steps; NaN: there are
  /// none.
  double last_slope(std::size_t quantity) const;
};

/// Measures every step, and prints a table meanwhile. Leaves out steps that need more memory than
/// there is, and says so beforehand.
ScalingCurve run_sweep(const Sweep& sweep);

std::string to_csv(const std::vector<ScalingCurve>& curves);

/// The median of each value that `run` returns, over several runs; the longer they take, the fewer.
std::vector<double> median_of_runs(const std::function<std::vector<double>()>& run);

/// Are so many runs, which took so many seconds together, enough?
bool enough(std::size_t runs, double seconds);

}  // namespace octolux
