// From a file to a Scene: Mitsuba XML (.xml), or a bare Wavefront .obj with its .mtl.
#pragma once

#include <memory>
#include <string>

#include "renderer/load_options.h"
#include "renderer/scene.h"

namespace octolux {

/// Loads and completes the scene. Throws Error: one line with file:line, what is wrong, what was
/// expected. What changes no pixel is ignored with one warning in Scene::warnings.
std::unique_ptr<Scene> load_scene(const std::string& path, const LoadOptions& options);

}  // namespace octolux
