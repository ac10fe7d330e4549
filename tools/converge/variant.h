// What is raced against time: an integrator with its kernel, photon count and gathering.
#pragma once

#include <string>
#include <vector>

#include "renderer/config.h"

namespace octolux {

struct Variant {
  std::string name;  // says what differs between the variants
  RenderConfig config;
};

/// The choices whose product is raced. Path tracing knows of none but itself.
struct VariantChoices {
  std::vector<std::string> integrators{"photon", "path"};
  std::vector<std::string> kernels{"cone", "octobox", "feeler"};  // as parse_lab_kernel reads them
  std::vector<std::int64_t> photons;  // paths per pass for the global map; empty: the settings'
  std::vector<std::string> gathers{"on"};
};

/// Every variant once, over `settings`, which say all else. Throws Error for illegal names.
std::vector<Variant> make_variants(const VariantChoices& choices, const RenderConfig& settings);

}  // namespace octolux
