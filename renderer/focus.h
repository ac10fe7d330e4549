// Where photons will be read, and how wide that is: of a scene with ground for a kilometre around a
// house the room, and of a detail of the room as well, as gather rays go through all of it. Photons
// of sun and sky are worth most there (core/scene_sphere.h, photon_scatter.h).
#pragma once

#include <optional>

#include "core/vec.h"

namespace octolux {

struct Scene;

struct Focus {
  Vec3 center;
  float radius = 0;  // [m] half of what is read is nearer to the center
};

/// By some eye paths; empty if hardly any gather ray meets a surface. The scene is complete but for
/// its lights.
std::optional<Focus> find_focus(const Scene& scene);

}  // namespace octolux
