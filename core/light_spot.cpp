// A point that shines into a cone, full inside the beam and fading linearly with the angle to the
// cutoff; a texture may be put in front like a slide. Semantics of Mitsuba's `spot`.
#include <cmath>

#include "core/light.h"
#include "core/light_at_point.h"
#include "core/sampling.h"

namespace octolux {
namespace {

class SpotLight final : public Light {
 public:
  explicit SpotLight(const SpotConfig& config)
      : config_(config),
        position_(config.to_world.point({0, 0, 0})),
        frame_(frame_of(config.to_world)),
        versine_(1 - std::cos(config.cutoff)),
        solid_angle_(2 * kPi * 2 * std::sin(config.cutoff / 2) * std::sin(config.cutoff / 2)) {
    power_ = integral(static_cast<double>(solid_angle_), 128,
                      [this](Vec2 u) { return intensity(sample_cone(u, versine_)); });
  }

  std::optional<LightSample> sample(Vec3 x, Vec2 /*u*/) const override {
    return sample_point(position_, x, [&](Vec3 w) { return intensity(frame_.to_local(w)); });
  }

  EmittedPhoton emit(Vec2 /*u_position*/, Vec2 u_direction) const override {
    const Vec3 local = sample_cone(u_direction, versine_);
    return {{position_, normalize(frame_.to_world(local))}, intensity(local) * solid_angle_};
  }

  Rgb power() const override { return power_; }

  std::optional<LightExtent> extent() const override {
    const float fade = config_.cutoff - config_.beam;
    if (!(fade <= kPi / 2)) return LightExtent{{position_, position_}};
    return LightExtent{{position_, position_}, frame_.n, config_.beam, fade};
  }

 private:
  /// [W sr^-1] along a local direction.
  Rgb intensity(Vec3 w) const {
    const float angle = std::atan2(std::hypot(w.x, w.y), w.z);
    if (!(angle < config_.cutoff)) return Rgb(0);
    const float fade =
        angle <= config_.beam ? 1 : (config_.cutoff - angle) / (config_.cutoff - config_.beam);
    const Rgb bare = config_.intensity * fade;
    if (!config_.texture) return bare;
    const float half = 0.5f / (w.z * std::tan(config_.cutoff));
    return bare * config_.texture->eval({0.5f + w.x * half, 0.5f + w.y * half});
  }

  SpotConfig config_;
  Vec3 position_;
  Frame frame_;
  float versine_;      // of the cutoff
  float solid_angle_;  // [sr] of the cone
  Rgb power_;
};

}  // namespace

std::unique_ptr<Light> make_spot_light(const SpotConfig& config) {
  return std::make_unique<SpotLight>(config);
}

}  // namespace octolux
