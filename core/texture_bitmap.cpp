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
    for (const Rgb c : image_.pixels) {
      r += c.r, g += c.g, b += c.b;
      maximum_ = std::max(maximum_, max_component(c));
    }
    const double n = static_cast<double>(image_.pixels.size());
    mean_ = Rgb(static_cast<float>(r / n), static_cast<float>(g / n), static_cast<float>(b / n));
  }

  Rgb eval(const TexturePoint& uv) const override {
    const Vec3 p = config_.to_uv.point({uv.x, uv.y, 1});
    const float x = into_image(p.x, config_.wrap_u, image_.width);
    const float y = into_image(p.y, config_.wrap_v, image_.height);
    return config_.filter == TextureFilter::nearest ? nearest(x, y) : bilinear(x, y);
  }

  Rgb mean() const override { return mean_; }
  float maximum() const override { return std::max(maximum_, max_outside()); }
  float aspect() const override {
    return static_cast<float>(image_.width) / static_cast<float>(image_.height);
  }

  /// Exact derivative of the bilinear interpolation, carried back through to_uv.
  Vec2 gradient(const TexturePoint& uv) const override {
    if (config_.filter == TextureFilter::nearest) return {0, 0};
    const Vec3 p = config_.to_uv.point({uv.x, uv.y, 1});
    const Cell c = cell(into_image(p.x, config_.wrap_u, image_.width),
                        into_image(p.y, config_.wrap_v, image_.height));
    const auto value = [&](int i, int j) { return luminance(texel(c.x + i, c.y + j)); };
    const float v00 = value(0, 0), v10 = value(1, 0), v01 = value(0, 1), v11 = value(1, 1);
    const double du =
        ((v10 - v00) * (1 - c.t) + (v11 - v01) * c.t) * static_cast<float>(image_.width);
    const double dv =
        ((v01 - v00) * (1 - c.s) + (v11 - v10) * c.s) * static_cast<float>(image_.height);
    const auto& m = config_.to_uv.m;
    return {static_cast<float>(m[0][0] * du + m[1][0] * dv),
            static_cast<float>(m[0][1] * du + m[1][1] * dv)};
  }

 private:
  /// Texture coordinate to pixels, brought near the image first so that it fits an int. A mirrored
  /// image has period 2.
  static float into_image(float u, TextureWrap wrap, int size) {
    switch (wrap) {
      case TextureWrap::repeat:
        u -= std::floor(u);
        break;
      case TextureWrap::mirror:
        u -= 2 * std::floor(u / 2);
        break;
      case TextureWrap::clamp:
        u = std::clamp(u, 0.0f, 1.0f);
        break;
      default:
        u = std::clamp(u, -0.5f, 1.5f);
        break;
    }
    return u * static_cast<float>(size);
  }

  /// Pixel index in [-1, 2 size] to one in [0, size); others stay outside.
  static int wrapped(int i, TextureWrap wrap, int size) {
    switch (wrap) {
      case TextureWrap::repeat:
        return (i + size) % size;
      case TextureWrap::mirror:
        i = (i + 2 * size) % (2 * size);
        return std::min(i, 2 * size - 1 - i);
      case TextureWrap::clamp:
        return std::clamp(i, 0, size - 1);
      default:
        return i;
    }
  }

  Rgb texel(int x, int y) const {
    x = wrapped(x, config_.wrap_u, image_.width);
    y = wrapped(y, config_.wrap_v, image_.height);
    if (x < 0 || x >= image_.width) return outside(config_.wrap_u);
    if (y < 0 || y >= image_.height) return outside(config_.wrap_v);
    return image_.at(x, y);
  }
  float max_outside() const {
    return max_component(outside(config_.wrap_u) + outside(config_.wrap_v)) > 0 ? 1 : 0;
  }
  static Rgb outside(TextureWrap wrap) { return Rgb(wrap == TextureWrap::one ? 1.0f : 0.0f); }

  Rgb nearest(float x, float y) const {
    return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
  }

  /// Four texels, the first at (x, y), and the place between them.
  struct Cell {
    int x, y;
    float s, t;
  };
  static Cell cell(float x, float y) {
    const float x0 = std::floor(x - 0.5f), y0 = std::floor(y - 0.5f);
    return {static_cast<int>(x0), static_cast<int>(y0), x - 0.5f - x0, y - 0.5f - y0};
  }

  Rgb bilinear(float x, float y) const {
    const auto [i, j, s, t] = cell(x, y);
    const Rgb top = texel(i, j) * (1 - s) + texel(i + 1, j) * s;
    const Rgb bottom = texel(i, j + 1) * (1 - s) + texel(i + 1, j + 1) * s;
    return top * (1 - t) + bottom * t;
  }

  Image image_;
  BitmapConfig config_;
  Rgb mean_;
  float maximum_ = 0;
};

}  // namespace

std::unique_ptr<Texture> make_bitmap_texture(Image image, const BitmapConfig& config) {
  return std::make_unique<BitmapTexture>(std::move(image), config);
}

}  // namespace octolux
