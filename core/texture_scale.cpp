// A texture times a constant, Mitsuba 0.6's `scale`, and one cut off at 1. Immutable, so
// thread-safe.
#include "core/texture.h"

namespace octolux {
namespace {

class ScaleTexture final : public Texture {
 public:
  ScaleTexture(const Texture& inner, Rgb factor) : inner_(inner), factor_(factor) {}

  Rgb eval(const TexturePoint& uv) const override { return inner_.eval(uv) * factor_; }
  Rgb mean() const override { return inner_.mean() * factor_; }
  float maximum() const override { return inner_.maximum() * max_component(factor_); }
  float aspect() const override { return inner_.aspect(); }
  /// Colour factors are rare here, and count by their luminance.
  Vec2 gradient(const TexturePoint& uv) const override {
    return inner_.gradient(uv) * luminance(factor_);
  }

 private:
  const Texture& inner_;
  Rgb factor_;
};

class ClampedTexture final : public Texture {
 public:
  explicit ClampedTexture(const Texture& inner) : inner_(inner) {}

  Rgb eval(const TexturePoint& uv) const override { return clamped(inner_.eval(uv)); }
  Rgb mean() const override { return clamped(inner_.mean()); }
  float maximum() const override { return std::min(inner_.maximum(), 1.0f); }
  float aspect() const override { return inner_.aspect(); }
  Vec2 gradient(const TexturePoint& uv) const override { return inner_.gradient(uv); }

 private:
  static Rgb clamped(Rgb c) {
    return {std::min(c.r, 1.0f), std::min(c.g, 1.0f), std::min(c.b, 1.0f)};
  }

  const Texture& inner_;
};

}  // namespace

std::unique_ptr<Texture> make_scale_texture(const Texture& inner, Rgb factor) {
  return std::make_unique<ScaleTexture>(inner, factor);
}

std::unique_ptr<Texture> make_clamped_texture(const Texture& inner) {
  return std::make_unique<ClampedTexture>(inner);
}

}  // namespace octolux
