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

enum class TextureFilter { nearest, bilinear };
enum class TextureWrap { repeat, mirror, clamp };  // outside the unit square

struct BitmapConfig {
  Affine to_uv{};  // applied to (u, v, 1) before the look-up; the third component is dropped
  TextureFilter filter = TextureFilter::bilinear;
  TextureWrap wrap = TextureWrap::repeat;
};
/// `image` (linear light, at least one pixel) over the unit square.
std::unique_ptr<Texture> make_bitmap_texture(Image image, const BitmapConfig& config);

/// Four squares per unit square: `color0` where u and v are in the same half.
std::unique_ptr<Texture> make_checkerboard_texture(Rgb color0, Rgb color1, const Affine& to_uv);

/// The attribute of that name (MeshAttribute) of the mesh that is looked at.
std::unique_ptr<Texture> make_mesh_attribute_texture(const std::string& name);

}  // namespace octolux
