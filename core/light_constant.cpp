// The same radiance from everywhere.
#include "core/light.h"
#include "core/sampling.h"
#include "core/scene_sphere.h"

namespace octolux {
namespace {

class ConstantLight final : public EnvironmentLight {
 public:
  explicit ConstantLight(Rgb radiance) : radiance_(radiance) {}

  std::optional<LightSample> sample(Vec3 /*x*/, Vec2 u) const override {
    if (is_black(radiance_)) return std::nullopt;
    LightSample s;
    s.wi = sample_sphere(u);
    s.radiance = radiance_;
    s.pdf_w = kUniformSpherePdfW;
    s.infinite = true;
    return s;
  }

  EmittedPhoton emit(Vec2 u_position, Vec2 u_direction) const override {
    const SceneSphere::Start start = scene_.incoming(sample_sphere(u_direction), u_position);
    return {start.ray, radiance_ * (4 * kPi / start.pdf_a)};
  }

  Rgb power() const override { return radiance_ * (4 * kPi * scene_.cross_section()); }

  void set_scene_bounds(Vec3 center, float radius) override { scene_ = {center, radius, center}; }

  void set_focus(Vec3 focus, float near) override { scene_.focus = focus, scene_.near = near; }

  Rgb radiance(Vec3 /*wi*/) const override { return radiance_; }
  float pdf_w(Vec3 /*wi*/) const override { return is_black(radiance_) ? 0 : kUniformSpherePdfW; }

 private:
  Rgb radiance_;
  SceneSphere scene_;
};

}  // namespace

std::unique_ptr<EnvironmentLight> make_constant_light(Rgb radiance) {
  return std::make_unique<ConstantLight>(radiance);
}

}  // namespace octolux
