// Texture maps of MTL materials, made from their files. What is missing or not modelled becomes a
// warning of the scene: a model without its pictures is still worth seeing.
#pragma once

#include <initializer_list>

#include "core/texture.h"
#include "renderer/mtl_file.h"
#include "renderer/scene.h"

namespace octolux {

enum class MtlMapUse {
  colour,  // sRGB if 8 bits
  data,    // opacity, height, normals: as it stands
};

/// The material's map of the first of `keys` that it has, or nullptr; owned by the scene.
const Texture* load_map(const MtlMaterial& material, std::initializer_list<const char*> keys,
                        MtlMapUse use, Scene& scene);

/// `bump`, `map_bump` or `norm`: wraps the BSDF `index`. A picture that is mostly blue holds
/// normals, whatever its key; others heights in scene units, times -bm. Returns the new index.
int add_relief(const MtlMaterial& material, int index, Scene& scene);

/// A warning for every map that none of the above reads.
void warn_of_other_maps(const MtlMaterial& material, Scene& scene);

}  // namespace octolux
