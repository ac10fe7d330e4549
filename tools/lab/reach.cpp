// See reach.h.
#include "tools/lab/reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace octolux {
namespace {

const std::vector<int> kFew{3, 4, 5, 7, 10, 15, 20, 30, 40};
const std::vector<int> kMany{50, 70, 100, 200, 400, 1000, 2000};
const std::vector<int> kAll{3, 4, 5, 7, 10, 15, 20, 30, 40, 50, 70, 100, 200, 400, 1000, 2000};

const std::vector<ReachMeasure> kMeasures{
    {"open plane, n 3 to 2000", 0.005, 0.005, {{"plane", 0, 0}}, kAll},
    {"wall through the query, any angle", 0.07, 0.01, {{"wall", 0, 0}}, kMany},
    {"wall at 0.1, 0.3, 0.6",
     0.07,
     0.01,
     {{"wall", 0.1, 0}, {"wall", 0.3, 0}, {"wall", 0.6, 0}},
     kMany},
    {"corner at the query, any angle", 0.07, 0.01, {{"corner", 0, 0}}, kMany},
    {"corner at 0.1, 0.3, 0.6",
     0.07,
     0.01,
     {{"corner", 0.1, 0}, {"corner", 0.3, 0}, {"corner", 0.6, 0}},
     kMany},
    {"strip 0.01, 0.06, 0.3, 1 wide, in the middle and at a wall, any angle",
     0.10,
     0.10,
     {{"strip", 0.5, 0.01},
      {"strip", 0.5, 0.06},
      {"strip", 0.5, 0.3},
      {"strip", 0.5, 1},
      {"strip", 0, 0.06},
      {"strip", 0, 0.3},
      {"strip", 0.2, 1}},
     kMany},
    {"re-entrant corner at the query", 0.12, 0.02, {{"reentrant", 0, 0}}, kMany},
    {"re-entrant corner at 0.1, 0.3",
     0.12,
     0.02,
     {{"reentrant", 0.1, 0}, {"reentrant", 0.3, 0}},
     kMany},
};

LabLayout layout_at(const ReachPlace& place) {
  return find_lab_case(place.lab_case).layout(place.distance, place.size);
}

std::string percent(const LabResult& r) {
  return fmt::format("{:+.1f} % (n {})", 100 * r.bias(), r.neighbours);
}

}  // namespace

std::span<const ReachMeasure> reach_measures() { return kMeasures; }

std::vector<LabResult> worst_bias(const ReachMeasure& measure, LabSettings settings) {
  settings.neighbours = measure.neighbours;
  std::vector<LabResult> worst(settings.kernels.size());
  for (LabResult& w : worst) w.mean = 1;
  for (const ReachPlace& place : measure.places) {
    const std::vector<LabResult> results = octolux::measure(layout_at(place), settings);
    for (std::size_t i = 0; i < results.size(); ++i) {
      LabResult& w = worst[i % worst.size()];
      if (std::abs(results[i].bias()) > std::abs(w.bias())) w = results[i];
    }
  }
  return worst;
}

std::vector<double> worst_noise(LabSettings settings, const std::vector<int>& neighbours) {
  const std::size_t kernels = settings.kernels.size();
  settings.kernels.push_back(parse_lab_kernel("disc"));
  settings.neighbours = neighbours;
  const std::vector<LabResult> results = measure(layout_at({"plane", 0, 0}), settings);
  std::vector<double> worst(kernels, 0);
  for (std::size_t i = 0; i < results.size(); i += kernels + 1) {
    const double disc = results[i + kernels].deviation;
    for (std::size_t k = 0; k < kernels; ++k) {
      worst[k] = std::max(worst[k], results[i + k].deviation / disc);
    }
  }
  return worst;
}

std::vector<std::vector<std::string>> reach_rows(const LabSettings& settings) {
  std::vector<std::vector<std::string>> rows;
  for (const ReachMeasure& measure : kMeasures) {
    rows.push_back({measure.name});
    for (const LabResult& r : worst_bias(measure, settings)) rows.back().push_back(percent(r));
  }
  const auto add_noise = [&](const char* name, const std::vector<int>& neighbours) {
    rows.push_back({name});
    for (const double ratio : worst_noise(settings, neighbours)) {
      rows.back().push_back(fmt::format("{:.2f} x", ratio));
    }
  };
  add_noise("noise against disc, n from 50", kMany);
  add_noise("noise against disc, n below 50", kFew);
  return rows;
}

}  // namespace octolux
