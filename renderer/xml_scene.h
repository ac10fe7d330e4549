// A Mitsuba scene file (0.5/0.6 and 2/3) as a Scene.
#pragma once

#include <string>

#include "renderer/load_options.h"
#include "renderer/scene.h"

namespace octolux {

/// Fills everything but what Scene::complete() makes. Throws Error.
void load_xml_scene(const std::string& path, const LoadOptions& options, Scene& scene);

}  // namespace octolux
