// A scene from a bare Wavefront OBJ with its MTL files: one shape per material, area lights where a
// material emits (Ke), a camera and if need be a headlight (obj_camera.h), materials as
// mtl_material.h says. Faces without normals are flat.
//
// OBJ surfaces have no inside, but area lights shine from their front only. So each connected open
// piece of an emitting surface that faces away from the middle of the scene is turned round, with a
// warning; closed pieces (bulbs) stay as they are.
#pragma once

#include <string>

#include "renderer/scene.h"

namespace octolux {

/// Fills `scene` (fresh) from the file at `path`, without completing it. Throws Error for what
/// cannot be read; what is assumed or ignored (a missing MTL, unknown materials, lines, texture
/// maps ...) is said in scene.warnings.
void load_obj_scene(const std::string& path, Scene& scene);

}  // namespace octolux
