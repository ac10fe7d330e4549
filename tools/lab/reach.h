// What the corrected kernels must reach, as a list of measurements: the table in
// estimators/README.md is made from it, and tests hold the kernels to it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/lab/measure.h"

namespace octolux {

struct ReachPlace {
  const char* lab_case;
  double distance, size;
};

/// The worst bias over places and numbers of photons.
struct ReachMeasure {
  const char* name;
  double limit;         // of |bias| for a corrected OctoBox
  double feeler_limit;  // the same for kernels that look at the geometry
  std::vector<ReachPlace> places;
  std::vector<int> neighbours;
};
std::span<const ReachMeasure> reach_measures();

/// The worst results of each of the settings' kernels (its neighbours are not used).
std::vector<LabResult> worst_bias(const ReachMeasure& measure, LabSettings settings);

/// Largest ratio of a kernel's noise on an open plane to that of disc, per kernel.
std::vector<double> worst_noise(LabSettings settings, const std::vector<int>& neighbours);

/// A table, one row per measure: its name, then a cell for each kernel.
std::vector<std::vector<std::string>> reach_rows(const LabSettings& settings);

}  // namespace octolux
