// Colour that may vary over a surface: a constant, or an image or pattern looked up by uv.
//
// Texture coordinates follow Mitsuba: v = 0 is the image's top row. OBJ files count v from the
// bottom, so their loader turns v into 1 - v (Mitsuba's flipTexCoords, on by default).
#pragma once

#include <memory>
#include <string>

#include "core/affine.h"
#include "core/image.h"
#include "core/rgb.h"
#include "core/texture_point.h"
#include "core/vec.h"

namespace octolux {

/// A pattern over uv. Immutable, so thread-safe. Values are linear Rec.709.
class Texture {
 public:
  virtual ~Texture() = default;
  virtual Rgb eval(const TexturePoint& at) const = 0;
  /// Mean over the unit square; for albedo estimates and for choosing lobes.
  virtual Rgb mean() const = 0;
  /// What it counts as where a number is wanted.
  virtual float number(const TexturePoint& at) const { return luminance(eval(at)); }
  /// Change of the value's luminance with u and v, for bump maps; 0 where it jumps.
  virtual Vec2 gradient(const TexturePoint& /*at*/) const { return {0, 0}; }
  /// No component is larger than this.
  virtual float maximum() const = 0;
  /// Width over height of its picture, in pixels; 1 if it has none.
  virtual float aspect() const { return 1; }
};

/// What a BSDF parameter holds: a constant without a virtual call, or a Texture of the scene (not
/// owned) times a constant.
class Color {
 public:
  Color(Rgb constant) : factor_(constant) {}  // NOLINT: a constant is a colour
  explicit Color(const Texture& texture, Rgb factor = Rgb(1))
      : factor_(factor), texture_(&texture) {}

  Rgb operator()(const TexturePoint& at) const {
    return texture_ ? factor_ * texture_->eval(at) : factor_;
  }
  Rgb mean() const { return texture_ ? factor_ * texture_->mean() : factor_; }
  bool is_constant() const { return !texture_; }

 private:
  Rgb factor_;
  const Texture* texture_ = nullptr;
};

/// The same for a parameter that is a number, such as a roughness: a texture counts by luminance.
class Scalar {
 public:
  Scalar(float constant) : constant_(constant) {}  // NOLINT: a number is a constant
  explicit Scalar(const Texture& texture) : texture_(&texture) {}

  float operator()(const TexturePoint& at) const {
    return texture_ ? texture_->number(at) : constant_;
  }
  float mean() const { return texture_ ? luminance(texture_->mean()) : constant_; }
  Vec2 gradient(const TexturePoint& at) const {
    return texture_ ? texture_->gradient(at) : Vec2{0, 0};
  }
  bool is_constant() const { return !texture_; }

 private:
  float constant_ = 0;
  const Texture* texture_ = nullptr;
};

enum class TextureFilter { nearest, bilinear };
enum class TextureWrap { repeat, mirror, clamp, zero, one };  // outside the unit square

struct BitmapConfig {
  Affine to_uv{};  // applied to (u, v, 1) before the look-up; the third component is dropped
  TextureFilter filter = TextureFilter::bilinear;
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};
/// `image` (linear light, at least one pixel) over the unit square.
std::unique_ptr<Texture> make_bitmap_texture(Image image, const BitmapConfig& config);

/// `inner` (not owned) times `factor`.
std::unique_ptr<Texture> make_scale_texture(const Texture& inner, Rgb factor);
/// `inner` (not owned), where it is above 1 cut to 1, for reflectances.
std::unique_ptr<Texture> make_clamped_texture(const Texture& inner);

/// Four squares per unit square: `color0` where u and v are in the same half.
std::unique_ptr<Texture> make_checkerboard_texture(Rgb color0, Rgb color1, const Affine& to_uv);

/// The attribute of that name (MeshAttribute) of the mesh that is looked at.
std::unique_ptr<Texture> make_mesh_attribute_texture(const std::string& name);

}  // namespace octolux
