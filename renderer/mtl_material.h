// From MTL materials to BSDFs, as users of McGuire's Computer Graphics Archive expect: colours are
// linear, surfaces are two-sided, and the illumination model says what it did in Wavefront's
// specification (MTL 4.2, 1995), except where common exporters write it without meaning it:
//
//   mirror   illum 3 or 5, or no illum with Ns >= 1000 and Kd 0; Ks above Kd. Reflectance Ks.
//   glass    illum 4, 6, 7 or 9, or opacity (d) below 1, or no illum with Tf above 0; each with
//            Ni != 1. Index Ni. Tf is the filter of a whole body, which light enters and leaves:
//            each surface transmits sqrt(Tf). Tf 0 or not given is clear.
//   mask     a map_d, or opacity below 1 with Ni = 1: light passes straight on, the rest is as
//   below. glossy   Ks above 0, unless illum is 1: Kd under GGX with alpha = sqrt(2 / (Ns + 2)).
//   diffuse  all else. A material that says nothing at all is grey, 0.5.
//
// (`illum 4` with Ni 1 and d 1 is what Maya writes for everything; it is opaque.)
#pragma once

#include <string>
#include <vector>

#include "renderer/mtl_file.h"
#include "renderer/scene.h"

namespace octolux {

enum class MtlKind { diffuse, glossy, mirror, glass };

/// The rules above, without the mask.
MtlKind kind(const MtlMaterial& material);

/// Adds the material's BSDF (and those it is made from) to the scene, and warnings about what is
/// ignored or out of range. Returns its index in scene.bsdfs.
int add_bsdf(const MtlMaterial& material, Scene& scene);

/// What the material emits: Ke times map_Ke, radiance [W m^-2 sr^-1].
Color emission(const MtlMaterial& material, Scene& scene);

/// Adds the grey of surfaces without a material.
int add_default_bsdf(Scene& scene);

}  // namespace octolux
