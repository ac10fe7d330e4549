// Parameters that occur in scene files of exporters and of research branches of Mitsuba, that mean
// nothing to us and change no pixel. One table, so that there is one list of what is ignored.
#pragma once

#include "renderer/properties.h"
#include "renderer/scene_builder.h"

namespace octolux {

/// Takes those of the table out of `properties`, each with a warning (the first time it occurs).
void ignore_extras(Properties& properties, SceneBuilder& builder);

}  // namespace octolux
