// An image over the unit square, looked up nearest or bilinear, repeated, mirrored or clamped
// outside; texel centres lie at (i + 1/2) / size, as in Mitsuba's `bitmap`. No mip maps: a
// progressive render averages many samples per pixel. Immutable, so thread-safe.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/texture.h"

namespace octolux {
namespace {

class BitmapTexture final : public Texture {
 public:
  BitmapTexture(Image image, const BitmapConfig& config)
      : image_(std::move(image)), config_(config) {
    OCTOLUX_CHECK(image_.width > 0 && image_.height > 0);
    double r = 0, g = 0, b = 0;
    for (const Rgb c : image_.pixels) r += c.r, g += c.g, b += c.b;
    const double n = static_cast<double>(image_.pixels.size());
    mean_ = Rgb(static_cast<float>(r / n), static_cast<float>(g / n), static_cast<float>(b / n));
  }

  Rgb eval(const TexturePoint& uv) const override {
    const Vec3 p = config_.to_uv.point({uv.x, uv.y, 1});
    const float x = into_image(p.x, image_.width), y = into_image(p.y, image_.height);
    return config_.filter == TextureFilter::nearest ? nearest(x, y) : bilinear(x, y);
  }

  Rgb mean() const override { return mean_; }

 private:
  /// Texture coordinate to pixels, brought near the image first so that it fits an int. A mirrored
  /// image has period 2.
  float into_image(float u, int size) const {
    switch (config_.wrap) {
      case TextureWrap::repeat:
        u -= std::floor(u);
        break;
      case TextureWrap::mirror:
        u -= 2 * std::floor(u / 2);
        break;
      case TextureWrap::clamp:
        u = std::clamp(u, 0.0f, 1.0f);
        break;
    }
    return u * static_cast<float>(size);
  }

  /// Pixel index in [-1, 2 size] to one in [0, size).
  int wrap(int i, int size) const {
    switch (config_.wrap) {
      case TextureWrap::repeat:
        return (i + size) % size;
      case TextureWrap::mirror:
        i = (i + 2 * size) % (2 * size);
        return std::min(i, 2 * size - 1 - i);
      case TextureWrap::clamp:
        return std::clamp(i, 0, size - 1);
    }
    return 0;
  }

  Rgb texel(int x, int y) const { return image_.at(wrap(x, image_.width), wrap(y, image_.height)); }

  Rgb nearest(float x, float y) const { return texel(static_cast<int>(x), static_cast<int>(y)); }

  Rgb bilinear(float x, float y) const {
    const float x0 = std::floor(x - 0.5f), y0 = std::floor(y - 0.5f);
    const float s = x - 0.5f - x0, t = y - 0.5f - y0;
    const int i = static_cast<int>(x0), j = static_cast<int>(y0);
    const Rgb top = texel(i, j) * (1 - s) + texel(i + 1, j) * s;
    const Rgb bottom = texel(i, j + 1) * (1 - s) + texel(i + 1, j + 1) * s;
    return top * (1 - t) + bottom * t;
  }

  Image image_;
  BitmapConfig config_;
  Rgb mean_;
};

}  // namespace

std::unique_ptr<Texture> make_bitmap_texture(Image image, const BitmapConfig& config) {
  return std::make_unique<BitmapTexture>(std::move(image), config);
}

}  // namespace octolux
