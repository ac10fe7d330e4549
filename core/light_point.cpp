// A point that sends the same intensity everywhere.
#include "core/light_at_point.h"
#include "core/sampling.h"

namespace octolux {
namespace {

class PointLight final : public Light {
 public:
  PointLight(Vec3 position, Rgb intensity) : position_(position), intensity_(intensity) {}

  std::optional<LightSample> sample(Vec3 x, Vec2 /*u*/) const override {
    return sample_point(position_, x, [&](Vec3) { return intensity_; });
  }

  EmittedPhoton emit(Vec2 /*u_position*/, Vec2 u_direction) const override {
    return {{position_, sample_sphere(u_direction)}, power()};
  }

  Rgb power() const override { return intensity_ * (4 * kPi); }

  std::optional<LightExtent> extent() const override { return LightExtent{{position_, position_}}; }

 private:
  Vec3 position_;
  Rgb intensity_;  // [W sr^-1]
};

}  // namespace

std::unique_ptr<Light> make_point_light(Vec3 position, Rgb intensity) {
  return std::make_unique<PointLight>(position, intensity);
}

}  // namespace octolux
