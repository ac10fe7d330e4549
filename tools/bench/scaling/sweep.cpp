// sweep.h.
#include "tools/bench/scaling/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "tools/bench/measuring.h"

namespace octolux {
namespace {

constexpr std::size_t kMostRuns = 7;
constexpr double kLong = 10;      // [s] all runs of a step together; one run may take longer
constexpr double kDecade = 10.5;  // and a little, as steps do not come out exactly
constexpr double kGigabyte = 1e9;

/// Memory [bytes] that programs can still have without swapping; 0: the system does not say.
double available_memory() {
  std::ifstream in("/proc/meminfo");
  for (std::string key, unit; in >> key;) {
    double kibibytes = 0;
    in >> kibibytes;
    if (key == "MemAvailable:") return kibibytes * 1024;
    std::getline(in, unit);
  }
  return 0;
}

/// "10^7", "3.16e+06", "64".
std::string size_text(double size) {
  if (size < 1e4) return fmt::format("{:.4g}", size);
  const double exponent = std::log10(size);
  const bool power = std::abs(exponent - std::round(exponent)) < 1e-9;
  return power ? fmt::format("10^{:.0f}", exponent) : fmt::format("{:.3g}", size);
}

/// The sizes there is memory for; says what the largest needs, and what is left out.
std::vector<double> sizes_that_fit(const Sweep& sweep) {
  if (!sweep.memory) return sweep.sizes;
  const double have = available_memory(), largest = sweep.sizes.back();
  fmt::print("the largest step, {} {}, needs {:.1f} GB of memory; ", size_text(largest), sweep.unit,
             sweep.memory(largest) / kGigabyte);
  if (!(have > 0)) {
    fmt::print("how much there is the system does not say\n");
    return sweep.sizes;
  }
  fmt::print("{:.1f} GB are available\n", have / kGigabyte);
  std::vector<double> fitting;
  for (const double size : sweep.sizes) {
    if (sweep.memory(size) <= have) {
      fitting.push_back(size);
    } else {
      fmt::print("left out: {} {}, {:.1f} GB\n", size_text(size), sweep.unit,
                 sweep.memory(size) / kGigabyte);
    }
  }
  return fitting;
}

void print_header(const Sweep& sweep) {
  fmt::print("{:>12}", sweep.unit);
  for (const Quantity& q : sweep.quantities) {
    fmt::print("{:>22}", fmt::format("{} [{}]", q.name, q.unit));
    if (q.is_time()) fmt::print("{:>8}", "slope");
  }
  fmt::print("\n");
}

void print_last(const ScalingCurve& curve) {
  const std::size_t last = curve.steps.size() - 1;
  const ScalingStep& step = curve.steps[last];
  fmt::print("{:>12.0f}", step.size);
  for (std::size_t q = 0; q < step.values.size(); ++q) {
    fmt::print("{:>22.4g}", step.values[q]);
    if (!curve.sweep.quantities[q].is_time()) continue;
    fmt::print("{:>8}", last == 0 ? "" : fmt::format("{:.2f}", curve.slope(q, last)));
  }
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace

double ScalingCurve::slope(std::size_t quantity, std::size_t i) const {
  const ScalingStep &a = steps[i - 1], &b = steps[i];
  return std::log(b.values[quantity] / a.values[quantity]) / std::log(b.size / a.size);
}

double ScalingCurve::last_slope(std::size_t quantity) const {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    if (n >= 2 && step->size * kDecade < steps.back().size) break;
    const double u = std::log(step->size), v = std::log(step->values[quantity]);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  if (n < 2) return std::numeric_limits<double>::quiet_NaN();
  return (n * xy - x * y) / (n * xx - x * x);
}

ScalingCurve run_sweep(const Sweep& sweep) {
  fmt::print("{}\n", sweep.title);
  ScalingCurve curve{sweep, {}};
  const std::vector<double> sizes = sizes_that_fit(sweep);
  print_header(sweep);
  for (const double size : sizes) {
    curve.steps.push_back(sweep.measure(size));
    print_last(curve);
  }
  fmt::print("\n");
  return curve;
}

std::string to_csv(const std::vector<ScalingCurve>& curves) {
  std::string text = "sweep,size,size_unit,quantity,unit,value,slope\n";
  for (const ScalingCurve& curve : curves) {
    for (std::size_t i = 0; i < curve.steps.size(); ++i) {
      const ScalingStep& step = curve.steps[i];
      for (std::size_t q = 0; q < step.values.size(); ++q) {
        const Quantity& quantity = curve.sweep.quantities[q];
        const bool has_slope = i > 0 && quantity.is_time();
        text += fmt::format("{},{:.0f},{},{},{},{:.6g},{}\n", curve.sweep.name, step.size,
                            curve.sweep.unit, quantity.name, quantity.unit, step.values[q],
                            has_slope ? fmt::format("{:.4f}", curve.slope(q, i)) : "");
      }
    }
  }
  return text;
}

std::vector<double> median_of_runs(const std::function<std::vector<double>()>& run) {
  std::vector<std::vector<double>> values;  // per quantity
  const Stopwatch watch;
  std::size_t runs = 0;
  do {
    const std::vector<double> one = run();
    values.resize(one.size());
    for (std::size_t q = 0; q < one.size(); ++q) values[q].push_back(one[q]);
    ++runs;
  } while (!enough(runs, watch.seconds()));
  std::vector<double> medians;
  for (const std::vector<double>& v : values) medians.push_back(median(v));
  return medians;
}

bool enough(std::size_t runs, double seconds) { return runs >= kMostRuns || seconds >= kLong; }

}  // namespace octolux
