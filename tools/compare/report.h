// A comparison in words and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/compare/comparison.h"
#include "tools/compare/gates.h"

namespace octolux {

/// A table of figures with their formulas, then lines about noise and values that are not finite.
std::string to_text(const Comparison& comparison);

/// Every number in full precision; what is not finite becomes null. Figures by their keys:
/// /images/0/layers/0/figures/relmse.
nlohmann::ordered_json to_json(const Comparison& comparison, const std::vector<GateResult>& gates);

}  // namespace octolux
