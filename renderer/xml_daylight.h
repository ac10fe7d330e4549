// Mitsuba 0.6's emitters `sun`, `sky` and `sunsky`; the models are in core/sky.h.
#pragma once

#include "renderer/properties.h"
#include "renderer/scene_builder.h"

namespace octolux {

void add_sun(Properties& p, SceneBuilder& b);
void add_sky(Properties& p, SceneBuilder& b);
void add_sun_and_sky(Properties& p, SceneBuilder& b);

}  // namespace octolux
