// Indices of refraction by name, as scene files give them: the names that Mitsuba knows.
// Pure functions of constant tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/rgb.h"

namespace octolux {

/// Index of a transparent material at the sodium line (589 nm), e.g. "bk7"; case does not matter.
std::optional<float> named_ior(const std::string& name);
std::vector<std::string> ior_names();

struct ConductorIor {
  Rgb eta;  // index of refraction
  Rgb k;    // extinction coefficient
};

/// Complex index of a metal or semiconductor, e.g. "Au"; "none" is a perfect mirror. Case matters,
/// as in chemistry.
std::optional<ConductorIor> named_conductor(const std::string& name);
std::vector<std::string> conductor_names();

}  // namespace octolux
