// The picture while it is being made: per pixel the sum and the sum of squares over the passes, so
// that every picture knows its own variance, and the layers that describe what was seen.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "core/vec.h"

namespace octolux {

/// What one eye sample saw, split by path class where the integrator tells them apart.
struct EyeSample {
  Rgb direct;       // L S* E and L D S* E
  Rgb caustic;      // L S+ D S* E
  Rgb indirect;     // the rest; everything of the path tracer's
  Rgb albedo;       // at the first surface
  Vec3 normal;      // shading normal there
  float depth = 0;  // along the view axis [m]; 0 where nothing was hit

  Rgb radiance() const { return direct + caustic + indirect; }
};

/// The picture of one pass: mean of its eye samples per pixel.
using PassImage = std::vector<EyeSample>;

class Film {
 public:
  Film(int width, int height);

  void add(const PassImage& pass);
  /// Notes that a pass left out `count` samples, the first at `pixel` (y * width + x).
  void note_non_finite(std::int64_t count, std::size_t pixel);

  int width() const { return width_; }
  int height() const { return height_; }
  int passes() const { return passes_; }

  Image radiance() const;
  Image direct() const { return mean_of(&Pixel::direct); }
  Image caustic() const { return mean_of(&Pixel::caustic); }
  Image indirect() const { return mean_of(&Pixel::indirect); }
  Image albedo() const { return mean_of(&Pixel::albedo); }
  /// Variance of the mean, per channel, from the spread of the passes; 0 with fewer than two.
  Image variance() const;
  Image normal() const;  // X Y Z in r g b; unit where something was hit
  std::vector<float> depth() const;

  /// Mean over pixels of standard error / (mean + 1 % of the picture's mean), of luminance.
  double relative_error() const;
  /// Samples that were not finite; they were left out, counted, and make the render fail.
  std::int64_t non_finite() const { return non_finite_; }
  /// Where and in which pass (from 0) the first of them was.
  struct Place {
    int x = 0, y = 0, pass = 0;
  };
  Place first_non_finite() const { return first_non_finite_; }

  /// All sums, exactly, as bytes of this machine; for checkpoint.h, which knows whose they are.
  std::string to_bytes() const;
  /// False, and nothing done, unless `bytes` have the length of a film of this one's size.
  bool from_bytes(std::string_view bytes);

 private:
  struct Tally;
  struct Pixel {
    Rgb direct, caustic, indirect, albedo;  // sums over passes
    Vec3 normal;
    float depth = 0;
    double sum[3] = {}, square[3] = {};  // of radiance per channel
    double luminance_square = 0;

    void add(const EyeSample& sample);
  };
  Image mean_of(Rgb Pixel::*field) const;

  int width_, height_;
  int passes_ = 0;
  std::int64_t non_finite_ = 0;
  Place first_non_finite_;
  std::vector<Pixel> pixels_;
};

}  // namespace octolux
