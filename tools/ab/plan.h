// What `octolux ab` renders: one scene with everything the same but the kernel and the gathering.
#pragma once

#include <string>
#include <vector>

#include "renderer/config.h"

namespace octolux {

/// One picture to be rendered.
struct AbRender {
  std::string name;  // for people: "cone", or "cone, gather off" where both are rendered
  std::string stem;  // of its files: "cone-gather-off"
  RenderConfig config;
};

/// `base` with each kernel ("cone", "octobox:published", ...) and each gathering ("off", "on"), in
/// this order. Throws Error for names that are not legal or there twice.
std::vector<AbRender> plan_renders(const RenderConfig& base,
                                   const std::vector<std::string>& kernels,
                                   const std::vector<std::string>& gatherings);

}  // namespace octolux
