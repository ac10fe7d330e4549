// BSDFs that change or add up others, which they refer to and do not own: parameters and makers.
// The surfaces themselves are in bsdf_makers.h.
#pragma once

#include <memory>
#include <span>

#include "core/bsdf.h"

namespace octolux {

struct CoatingConfig {
  float eta = 1.5046f / 1.000277f;
  float thickness = 1;    // in units of 1 / sigma_a
  Color sigma_a{Rgb(0)};  // absorption
  Rgb specular_reflectance{1, 1, 1};
};
/// `inner` under a smooth dielectric layer; Mitsuba 0.6's `coating`.
std::unique_ptr<Bsdf> make_coating(const Bsdf& inner, const CoatingConfig& config);

/// What Mitsuba 3 does, and 0.6 does not, where a tilted normal has no meaning.
struct TiltRepairs {
  bool mirror = true;  // a normal that faces away from the viewer is mirrored about the surface's
  bool fade = true;    // light at grazing angles fades
};
/// `inner` with its shading normal tilted by a height field: `height` is in scene units, times
/// `scale`.
std::unique_ptr<Bsdf> make_bump_map(const Bsdf& inner, Scalar height, float scale,
                                    TiltRepairs repairs = {});
/// `inner` with its shading normal given by a texture, (n + 1) / 2 in the frame of the tangents.
std::unique_ptr<Bsdf> make_normal_map(const Bsdf& inner, Color normals, TiltRepairs repairs = {});

/// (1 - weight) `first` + weight `second`, weight clamped to [0, 1].
std::unique_ptr<Bsdf> make_blend(const Bsdf& first, const Bsdf& second, Scalar weight);
struct WeightedBsdf {
  const Bsdf* bsdf;
  float weight;
};
/// Weighted sum; the weights add up to at most 1.
std::unique_ptr<Bsdf> make_mixture(std::span<const WeightedBsdf> parts);

/// `front` seen from the front, `back` (flipped) from behind. Neither may transmit.
std::unique_ptr<Bsdf> make_two_sided(const Bsdf& front, const Bsdf& back);

/// `inner` where opaque; light passes straight on where not.
std::unique_ptr<Bsdf> make_mask(const Bsdf& inner, Color opacity);

}  // namespace octolux
