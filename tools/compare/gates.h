// Gates: limits on figures that a comparison must keep, for scripts and regression tests.
#pragma once

#include <string>
#include <vector>

#include "tools/compare/comparison.h"

namespace octolux {

struct Gate {
  const Figure* figure = nullptr;  // nullptr: the difference must be within the noise
  double limit = 0;                // for smaller-is-better figures the largest legal value
};

/// "--max-relmse", "--min-psnr"; "" for a figure that has no gate.
std::string gate_option(const Figure& figure);

struct GateResult {
  std::string image, layer, gate;
  bool passed = false;
  std::string line;  // what there is to say, in one line
};

/// Every gate against every layer of every image, in order; and, if there is any gate, one failure
/// for each picture with values that are not finite. Throws Error if a gate needs a figure that the
/// comparison has not got.
std::vector<GateResult> check_gates(const Comparison& comparison, const std::vector<Gate>& gates);

}  // namespace octolux
