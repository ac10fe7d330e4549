// Light sources: sampled towards a point (next-event estimation) and emitting photons.
//
// Both views describe the same light: the mean over u of radiance / pdf_w * g(wi) is the integral
// of arriving radiance times g, and the mean of emitted flux is the power. Radiance that leaves a
// surface does so only where the cosine with its ng is positive. Nothing here is ever NaN: a light
// that is degenerate (no area, black, or exactly where x is) samples nothing, and has no power.
#pragma once

#include <memory>
#include <optional>

#include "core/affine.h"
#include "core/image.h"
#include "core/ray.h"
#include "core/rgb.h"
#include "core/shape.h"
#include "core/texture.h"

namespace octolux {

/// A direction in which light reaches a point x, if nothing is in between.
struct LightSample {
  Vec3 wi;             // unit, from x towards the light
  Rgb radiance;        // [W m^-2 sr^-1] arriving; for a delta light intensity / distance^2 [W m^-2]
  float pdf_w = 0;     // [sr^-1] at x; 1 for a delta light
  bool delta = false;  // point light: BSDF sampling never finds it
  bool infinite = false;
  SurfacePoint at;  // where the light comes from (all but shape and uv); unset if infinite
};

/// A photon leaving a light.
struct EmittedPhoton {
  Ray ray;              // starts off the light's surface; from infinite lights behind the scene
  Rgb flux;             // [W] emitted radiance * cosine / pdf: mean over many = power of the light
  bool narrow = false;  // from a light that is
};

/// Where a finite light is and where it shines to: every point of it lies in `bounds`, every normal
/// within the angle `normals` of `axis`, and light leaves within the angle `emission` of a normal.
struct LightExtent {
  Bounds bounds;
  Vec3 axis{0, 0, 1};
  float normals = kPi;       // [rad], pi: everywhere
  float emission = kPi / 2;  // [rad], at most pi / 2
};

/// Immutable once the scene is complete, so thread-safe.
class Light {
 public:
  virtual ~Light() = default;

  /// A direction towards the light, seen from x; empty if no light can reach x this way.
  virtual std::optional<LightSample> sample(Vec3 x, Vec2 u) const = 0;

  /// A photon; `u_position` chooses where it starts, `u_direction` where it goes. Its flux is black
  /// if the light has no power.
  virtual EmittedPhoton emit(Vec2 u_position, Vec2 u_direction) const = 0;

  /// Emitted power [W]. Infinite lights: power through the scene's bounding sphere.
  virtual Rgb power() const = 0;

  /// Empty for a light infinitely far away.
  virtual std::optional<LightExtent> extent() const { return std::nullopt; }

  /// Does all its light come from so small a part of the sky, as the sun's does, that it casts
  /// sharp shadows?
  virtual bool narrow() const { return false; }

  /// Called once when the scene is complete, before anything is emitted or power() asked.
  virtual void set_scene_bounds(Vec3 /*center*/, float /*radius*/) {}

  /// After that: what matters lies around `focus`, most of it within `near` [m]. Infinite lights
  /// then send more photons that way, of less flux; 0 makes them forget it.
  virtual void set_focus(Vec3 /*focus*/, float /*near*/) {}
};

/// A shape that emits from its front side, cosine-distributed; its radiance may be a texture.
class AreaLight : public Light {
 public:
  /// Radiance leaving `y` (on this light's shape) towards `wo`.
  virtual Rgb radiance(const SurfacePoint& y, Vec3 wo) const = 0;
  /// Density [sr^-1] with which `sample(x)` chooses the direction towards y; 0 where y does not
  /// emit towards x. Uses y's position and ng.
  virtual float pdf_w(Vec3 x, const SurfacePoint& y) const = 0;
};

/// Light from all around, infinitely far away.
class EnvironmentLight : public Light {
 public:
  /// Radiance arriving from the direction `wi` (unit, away from the scene).
  virtual Rgb radiance(Vec3 wi) const = 0;
  /// Density [sr^-1] with which `sample` chooses wi, whatever x.
  virtual float pdf_w(Vec3 wi) const = 0;
};

/// `shape` must outlive the light and stay where it is. Radiance is finite and not negative.
std::unique_ptr<AreaLight> make_area_light(const Shape& shape, Color radiance);
std::unique_ptr<Light> make_point_light(Vec3 position, Rgb intensity);  // [W sr^-1]
/// Parallel light along `direction` (unit); irradiance [W m^-2] of a surface that faces it.
std::unique_ptr<Light> make_directional_light(Vec3 direction, Rgb irradiance);

struct SpotConfig {
  Affine to_world;   // the light is at its origin and shines along +z; uneven scales do not count
  Rgb intensity{1};  // [W sr^-1] on the axis
  float cutoff = 0.35f;  // angle [rad] beyond which there is no light, in (0, pi / 2)
  float beam = 0.26f;    // angle up to which it is full, at most `cutoff`; linear in between
  const Texture* texture = nullptr;  // a slide over the square around the cone; or none
};
/// Mitsuba's `spot`.
std::unique_ptr<Light> make_spot_light(const SpotConfig& config);

struct ProjectorConfig {
  Affine to_world;  // the light is at its origin and shines along +z; uneven scales do not count
  Color picture{Rgb(1)};  // irradiance / pi [W m^-2] of a screen at distance 1
  float width = 1;        // of the screen, along x
  float aspect = 1;       // width / height
};
/// Mitsuba 3's `projector`: u falls along x, v along y, as a camera there would see it.
std::unique_ptr<Light> make_projector_light(const ProjectorConfig& config);

std::unique_ptr<EnvironmentLight> make_constant_light(Rgb radiance);
/// `image` is latitude-longitude as in Mitsuba 3, before `to_world`: the top row is +y, the bottom
/// row -y; u = 0 (the left edge) is -z, u = 1/4 is +x, u = 1/2 +z, u = 3/4 -x. Of `to_world` only
/// the rotation (and mirroring) counts. `scale` multiplies the image. Negative and non-finite
/// values count as 0. Interpolated bilinearly and importance sampled. At least one pixel.
std::unique_ptr<EnvironmentLight> make_envmap_light(Image image, const Affine& to_world,
                                                    float scale);

/// Takes out of such an image what is far brighter than its mean and covers only a small part of
/// the sky, as the sun does: that as an image of its own, narrow as a light, both together the
/// image as it was. Empty if there is no such thing. NaN, infinite and negative values stay.
std::optional<Image> take_out_sun(Image& image);

}  // namespace octolux
