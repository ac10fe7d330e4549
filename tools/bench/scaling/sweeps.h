// What is measured: time against photons, triangles, lights, threads and pixels.
#pragma once

#include <string>
#include <vector>

#include "tools/bench/scaling/sweep.h"

namespace octolux {

/// All sweeps, with their full range of sizes. `cornell` is the scene file of three of them.
std::vector<Sweep> all_sweeps(const std::string& cornell);

}  // namespace octolux
