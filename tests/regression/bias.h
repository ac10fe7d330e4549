// What the kernels say about their own bias: the worst over all places (walls, corners, strips,
// re-entrant corners) that estimators/README.md states for 50 neighbours and more, relative to the
// truth. Two standard errors of the measurements behind it (0.2 % each) are added. Not fitted to
// any picture.
#pragma once

#include <cmath>
#include <map>
#include <string>

#include "core/error.h"

namespace octolux::test {

/// Relative bias of an estimate of irradiance lies in [low, high].
struct StatedBias {
  double low = 0, high = 0;
};

/// Within a bandwidth of a wall, corner or edge.
inline StatedBias stated_bias_near_edges(const std::string& kernel) {
  static const std::map<std::string, StatedBias> stated = {
      {"disc", {-0.998, 0.008}}, {"cone", {-0.994, 0.009}},   {"octobox", {-0.059, 0.031}},
      {"hull", {-0.168, 0.014}}, {"feeler", {-0.004, 0.004}}, {"region", {-0.004, 0.004}},
  };
  const auto found = stated.find(kernel);
  if (found == stated.end()) throw Error("no bias is stated for " + kernel);
  return found->second;
}

/// Away from them, on an open plane.
inline StatedBias stated_bias_in_the_open() { return {-0.004, 0.009}; }

}  // namespace octolux::test
