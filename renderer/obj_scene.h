// A bare Wavefront OBJ file, with its MTL, as a scene.
#pragma once

#include <string>

#include "renderer/scene.h"

namespace octolux {

/// Fills shapes, bsdfs, lights, camera, warnings. Throws Error.
void load_obj_scene(const std::string& path, Scene& scene);

}  // namespace octolux
