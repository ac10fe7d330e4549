// From a file to a Scene: Mitsuba XML (.xml), or a bare Wavefront .obj with its .mtl.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "renderer/scene.h"

namespace octolux {

struct LoadOptions {
  std::map<std::string, std::string> defines;  // -D name=value: wins over <default>
};

/// Loads and completes the scene. Throws Error: one line with file:line, what is wrong, what was
/// expected. What changes no pixel is ignored with one warning in Scene::warnings.
std::unique_ptr<Scene> load_scene(const std::string& path, const LoadOptions& options);

}  // namespace octolux
