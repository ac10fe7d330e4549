// A Mitsuba scene file (0.5/0.6 and 2/3) as a Scene.
#pragma once

#include <map>
#include <string>

#include "renderer/load_progress.h"
#include "renderer/scene.h"

namespace octolux {

/// Fills everything but what Scene::complete() makes. Throws Error.
void load_xml_scene(const std::string& path, const std::map<std::string, std::string>& defines,
                    Scene& scene, const LoadProgress& progress = {});

}  // namespace octolux
