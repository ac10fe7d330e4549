// A point that throws a picture: the counterpart of a perspective camera. A screen at distance 1 at
// right angles to the axis receives pi times the picture, in the units of the file (Mitsuba 3's
// `projector`); seen along w, at the angle theta to the axis, the intensity is that over
// cos^3 theta. Immutable, so thread-safe.
#include <cmath>

#include "core/light.h"
#include "core/light_at_point.h"
#include "core/sampling.h"

namespace octolux {
namespace {

class Projector final : public Light {
 public:
  explicit Projector(const ProjectorConfig& config)
      : config_(config),
        position_(config.to_world.point({0, 0, 0})),
        frame_(frame_of(config.to_world)),
        half_{config.width / 2, config.width / 2 / config.aspect} {
    power_ = integral(static_cast<double>(kPi * area()), 256,
                      [this](Vec2 u) { return config_.picture(u); });
  }

  std::optional<LightSample> sample(Vec3 x, Vec2 /*u*/) const override {
    return sample_point(position_, x, [&](Vec3 w) { return intensity(frame_.to_local(w)); });
  }

  /// Uniform over the screen.
  EmittedPhoton emit(Vec2 /*u_position*/, Vec2 u_direction) const override {
    const Vec3 screen{(1 - 2 * u_direction.x) * half_.x, (1 - 2 * u_direction.y) * half_.y, 1};
    return {{position_, normalize(frame_.to_world(screen))},
            config_.picture(u_direction) * (kPi * area())};
  }

  Rgb power() const override { return power_; }

  std::optional<LightExtent> extent() const override {
    const float corner = std::atan(std::hypot(half_.x, half_.y));
    return LightExtent{{position_, position_}, frame_.n, corner, 0};
  }

 private:
  float area() const { return 4 * half_.x * half_.y; }

  /// [W sr^-1] along a local direction.
  Rgb intensity(Vec3 w) const {
    if (!(w.z > 0)) return Rgb(0);
    const float u = 0.5f - w.x / (w.z * 2 * half_.x), v = 0.5f - w.y / (w.z * 2 * half_.y);
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1)) return Rgb(0);
    return config_.picture(Vec2{u, v}) * (kPi / (w.z * w.z * w.z));
  }

  ProjectorConfig config_;
  Vec3 position_;
  Frame frame_;
  Vec2 half_;  // of the screen at distance 1
  Rgb power_;
};

}  // namespace

std::unique_ptr<Light> make_projector_light(const ProjectorConfig& config) {
  return std::make_unique<Projector>(config);
}

}  // namespace octolux
