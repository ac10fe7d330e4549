// Parallel light from infinitely far away.
#include "core/light.h"
#include "core/scene_sphere.h"

namespace octolux {
namespace {

class DirectionalLight final : public Light {
 public:
  DirectionalLight(Vec3 direction, Rgb irradiance) : wi_(-direction), irradiance_(irradiance) {}

  std::optional<LightSample> sample(Vec3 /*x*/, Vec2 /*u*/) const override {
    if (is_black(irradiance_)) return std::nullopt;
    LightSample s;
    s.wi = wi_;
    s.radiance = irradiance_;
    s.pdf_w = 1;
    s.delta = true;
    s.infinite = true;
    return s;
  }

  EmittedPhoton emit(Vec2 u_position, Vec2 /*u_direction*/) const override {
    const SceneSphere::Start start = scene_.incoming(wi_, u_position);
    return {start.ray, irradiance_ / start.pdf_a};
  }

  bool narrow() const override { return true; }

  Rgb power() const override { return irradiance_ * scene_.cross_section(); }

  void set_scene_bounds(Vec3 center, float radius) override { scene_ = {center, radius, center}; }

  void set_focus(Vec3 focus, float near) override { scene_.focus = focus, scene_.near = near; }

 private:
  Vec3 wi_;  // towards the light
  Rgb irradiance_;
  SceneSphere scene_;
};

}  // namespace

std::unique_ptr<Light> make_directional_light(Vec3 direction, Rgb irradiance) {
  return std::make_unique<DirectionalLight>(direction, irradiance);
}

}  // namespace octolux
