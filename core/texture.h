// Colour that may vary over a surface: a constant, or an image or pattern looked up by uv.
#pragma once

#include "core/rgb.h"
#include "core/vec.h"

namespace octolux {

/// A pattern over uv. Immutable, so thread-safe. Values are linear Rec.709.
class Texture {
 public:
  virtual ~Texture() = default;
  virtual Rgb eval(Vec2 uv) const = 0;
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

  Rgb operator()(Vec2 uv) const { return texture_ ? factor_ * texture_->eval(uv) : factor_; }
  Rgb mean() const { return texture_ ? factor_ * texture_->mean() : factor_; }
  bool is_constant() const { return !texture_; }

 private:
  Rgb factor_;
  const Texture* texture_ = nullptr;
};

}  // namespace octolux
