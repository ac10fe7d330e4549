// Light sources: sampled towards a point (next-event estimation) and emitting photons.
#pragma once

#include <memory>
#include <optional>

#include "core/image.h"
#include "core/ray.h"
#include "core/rgb.h"
#include "core/shape.h"

namespace octolux {

/// A direction in which light reaches a point x, if nothing is in between.
struct LightSample {
  Vec3 wi;             // unit, from x towards the light
  Rgb radiance;        // [W m^-2 sr^-1] arriving; for a delta light intensity / distance^2 [W m^-2]
  float pdf_w = 0;     // [sr^-1] at x; 1 for a delta light
  bool delta = false;  // point, directional: BSDF sampling never finds it
  bool infinite = false;
  SurfacePoint at;  // where the light comes from (position, ng, error); unset if infinite
};

/// A photon leaving a light.
struct EmittedPhoton {
  Ray ray;
  Rgb flux;  // [W] emitted radiance * cosine / pdf: mean over many = power of the light
};

/// Immutable once the scene is complete, so thread-safe.
class Light {
 public:
  virtual ~Light() = default;

  /// A direction towards the light, seen from x; empty if no light can reach x this way.
  virtual std::optional<LightSample> sample(Vec3 x, Vec2 u) const = 0;

  /// A photon; `u_position` chooses where it starts, `u_direction` where it goes.
  virtual EmittedPhoton emit(Vec2 u_position, Vec2 u_direction) const = 0;

  /// Emitted power [W]. Infinite lights: power through the scene's bounding sphere.
  virtual Rgb power() const = 0;

  /// Called once when the scene is complete.
  virtual void set_scene_bounds(Vec3 /*center*/, float /*radius*/) {}
};

/// A shape that emits from its front side, cosine-distributed, with the same radiance everywhere.
class AreaLight : public Light {
 public:
  /// Radiance leaving `y` (on this light's shape) towards `wo`.
  virtual Rgb radiance(const SurfacePoint& y, Vec3 wo) const = 0;
  /// Density [sr^-1] with which `sample(x)` chooses the direction towards y.
  virtual float pdf_w(Vec3 x, const SurfacePoint& y) const = 0;
};

/// Light from all around, infinitely far away.
class EnvironmentLight : public Light {
 public:
  /// Radiance arriving from the direction `wi` (unit, away from the scene).
  virtual Rgb radiance(Vec3 wi) const = 0;
  virtual float pdf_w(Vec3 wi) const = 0;
};

/// `shape` must outlive the light and stay where it is.
std::unique_ptr<AreaLight> make_area_light(const Shape& shape, Rgb radiance);
std::unique_ptr<Light> make_point_light(Vec3 position, Rgb intensity);  // [W sr^-1]
std::unique_ptr<EnvironmentLight> make_constant_light(Rgb radiance);
/// `image` is latitude-longitude as in Mitsuba (row 0 is +y, u = 0 is -z turning ... see .cpp),
/// turned by the rotation in `to_world`; `scale` multiplies it. Importance sampled.
std::unique_ptr<EnvironmentLight> make_envmap_light(Image image, const Affine& to_world,
                                                    float scale);

}  // namespace octolux
