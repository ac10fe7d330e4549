// What the camera looks at, and how wide that is: of a scene with ground for a kilometre around a
// house the room. Photons of sun and sky are worth most there (core/scene_sphere.h).
#pragma once

#include <optional>

#include "core/vec.h"

namespace octolux {

struct Scene;

struct Focus {
  Vec3 center;
  float radius = 0;  // [m] half of what is seen is nearer to the center
};

/// By rays through a grid over the film; empty if nothing is seen. The scene's caster and camera
/// are ready.
std::optional<Focus> find_focus(const Scene& scene);

}  // namespace octolux
