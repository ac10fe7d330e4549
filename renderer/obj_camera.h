// The view of a bare OBJ file, which has no camera: from +z towards -z with y up, so that McGuire's
// Cornell boxes, open at +z, are looked into; and the lamp at the camera when nothing shines. Both
// are announced in the scene's warnings.
#pragma once

#include "core/shape.h"
#include "renderer/scene.h"

namespace octolux {

/// A square picture, 45 degrees, that the front face (largest z) of `bounds` fills but for 5 %.
void frame_model(const Bounds& bounds, Scene& scene);

/// A point light at the camera; a white wall at the middle of `bounds`, facing it, gets radiance
/// 0.5. Call after frame_model.
void add_headlight(const Bounds& bounds, Scene& scene);

}  // namespace octolux
