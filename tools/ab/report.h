// The result of `octolux ab` as JSON and as a Markdown table.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/ab/result.h"

namespace octolux {

/// What the leak figures are, for people.
inline constexpr char kLightLeakFormula[] = "mean max(0, x-y) over the mask / mean y of the image";
inline constexpr char kShadowLeakFormula[] = "mean max(0, y-x) over the mask / mean y of the image";
inline constexpr char kNoiseFormula[] =
    "mean sqrt((var x + var y) / (2 pi)) over the mask / mean y of the image: what either leak "
    "would "
    "read from noise alone";

/// Every number in full precision; what is not finite becomes null. A picture's leaks:
/// /renders/0/masks/walls/light-leak, its other figures: /renders/0/masks/walls/figures/relmse.
nlohmann::ordered_json to_json(const AbResult& result);

/// Time, error and leaks of every picture, a line each.
std::string to_markdown(const AbResult& result);

/// Paragraphs, each one line, that say what was rendered and what the figures mean.
std::vector<std::string> explanations(const AbResult& result);

}  // namespace octolux
