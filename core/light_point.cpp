// A point that sends the same intensity everywhere.
#include "core/light.h"
#include "core/sampling.h"

namespace octolux {
namespace {

class PointLight final : public Light {
 public:
  PointLight(Vec3 position, Rgb intensity) : position_(position), intensity_(intensity) {}

  std::optional<LightSample> sample(Vec3 x, Vec2 /*u*/) const override {
    const Vec3 d = position_ - x;
    const float distance2 = length2(d);
    LightSample s;
    s.radiance = intensity_ / distance2;
    // Also catches distances whose square under- or overflows: then nothing sensible arrives.
    if (!(distance2 > 0) || !is_finite(s.radiance) || is_black(s.radiance)) return std::nullopt;
    s.wi = normalize(d);
    s.pdf_w = 1;
    s.delta = true;
    s.at.position = position_;
    s.at.ng = s.at.ns = -s.wi;
    return s;
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
