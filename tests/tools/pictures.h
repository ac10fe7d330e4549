// Pictures in memory for the tests of tools/compare.
#pragma once

#include <functional>
#include <string>

#include "core/rng.h"
#include "tools/compare/layer_view.h"

namespace octolux::test {

/// An image of colour(x, y).
inline Image paint(int width, int height, const std::function<Rgb(int, int)>& colour) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = colour(x, y);
  }
  return image;
}

inline Image constant(int width, int height, Rgb colour) {
  return paint(width, height, [&](int, int) { return colour; });
}

/// Independent uniform values in [0, scale).
inline Image random_image(int width, int height, std::uint64_t index, float scale = 1) {
  Rng rng(11, Stream::test, 0, index);
  Image image(width, height);
  for (Rgb& p : image.pixels) {
    p.r = scale * rng.uniform();
    p.g = scale * rng.uniform();
    p.b = scale * rng.uniform();
  }
  return image;
}

inline NamedPicture picture(const std::string& name, const Image& image) {
  return {name, {image.width, image.height, {rgb_layer("", image)}, {}}};
}

/// With a variance layer from `passes` passes.
inline NamedPicture noisy_picture(const std::string& name, const Image& image,
                                  const Image& variance, double passes) {
  NamedPicture noisy = picture(name, image);
  noisy.file.layers.push_back(rgb_layer("variance", variance));
  noisy.file.attributes.number["octolux.passes"] = passes;
  return noisy;
}

}  // namespace octolux::test
