// Mitsuba's `checkerboard`: four squares per unit square of texture space, `color0` where u and v
// lie in the same half of their period. Immutable, so thread-safe.
#include <cmath>

#include "core/texture.h"

namespace octolux {
namespace {

class CheckerboardTexture final : public Texture {
 public:
  CheckerboardTexture(Rgb color0, Rgb color1, const Affine& to_uv)
      : color0_(color0), color1_(color1), to_uv_(to_uv) {}

  Rgb eval(const TexturePoint& uv) const override {
    const Vec3 p = to_uv_.point({uv.x, uv.y, 1});
    return upper_half(p.x) == upper_half(p.y) ? color0_ : color1_;
  }

  Rgb mean() const override { return (color0_ + color1_) * 0.5f; }

 private:
  static bool upper_half(float x) { return x - std::floor(x) > 0.5f; }

  Rgb color0_, color1_;
  Affine to_uv_;
};

}  // namespace

std::unique_ptr<Texture> make_checkerboard_texture(Rgb color0, Rgb color1, const Affine& to_uv) {
  return std::make_unique<CheckerboardTexture>(color0, color1, to_uv);
}

}  // namespace octolux
