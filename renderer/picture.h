// The picture as it is saved: layers and the attributes from which it can be made again.
#pragma once

#include "core/image_io.h"
#include "renderer/render.h"

namespace octolux {

/// Layers: radiance (root), albedo, normal, depth, variance; with `split` also direct, caustic,
/// indirect.
ExrFile make_exr(const Scene& scene, const RenderConfig& config, const Progress& progress,
                 const Film& film, bool split);

}  // namespace octolux
