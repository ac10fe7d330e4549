// Indices of refraction by name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/rgb.h"

namespace octolux {

std::optional<float> named_ior(const std::string& name);
std::vector<std::string> ior_names();

struct ConductorIor {
  Rgb eta, k;
};
std::optional<ConductorIor> named_conductor(const std::string& name);
std::vector<std::string> conductor_names();

}  // namespace octolux
