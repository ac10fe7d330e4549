// The <bsdf> plug-ins that hold other BSDFs, made in xml_bsdfs_nested.cpp; the table that names
// them is in xml_bsdfs.cpp.
#pragma once

#include <memory>

#include "core/bsdf.h"
#include "renderer/properties.h"
#include "renderer/scene_builder.h"

namespace octolux {

std::unique_ptr<Bsdf> make_two_sided_bsdf(Properties& p, SceneBuilder& b);
std::unique_ptr<Bsdf> make_mask_bsdf(Properties& p, SceneBuilder& b);
std::unique_ptr<Bsdf> make_coating_bsdf(Properties& p, SceneBuilder& b);
std::unique_ptr<Bsdf> make_bump_map_bsdf(Properties& p, SceneBuilder& b);
std::unique_ptr<Bsdf> make_normal_map_bsdf(Properties& p, SceneBuilder& b);
std::unique_ptr<Bsdf> make_blend_bsdf(Properties& p, SceneBuilder& b);
std::unique_ptr<Bsdf> make_mixture_bsdf(Properties& p, SceneBuilder& b);

/// Interior index over exterior index; both a number or a material's name. `interior` is the
/// material if none is given; outside is air.
float read_eta(Properties& p, const char* interior);

}  // namespace octolux
