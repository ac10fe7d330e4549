// Layers in memory (image_io.h); files are the matter of exr_io.cpp and stb_io.cpp. Thread-safe.
#include "core/image_io.h"

#include <algorithm>

#include "core/error.h"

namespace octolux {
namespace {

const std::vector<float>* find_plane(const Layer& layer, const std::string& channel) {
  const auto i = std::find(layer.channels.begin(), layer.channels.end(), channel);
  return i == layer.channels.end() ? nullptr : &layer.planes[i - layer.channels.begin()];
}

}  // namespace

Layer rgb_layer(std::string name, const Image& image) {
  Layer layer{std::move(name), {"R", "G", "B"}, std::vector<std::vector<float>>(3)};
  for (int c = 0; c < 3; ++c) {
    layer.planes[c].reserve(image.pixels.size());
    for (const Rgb& p : image.pixels) layer.planes[c].push_back(p[c]);
  }
  return layer;
}

const Layer* ExrFile::find(const std::string& name) const {
  for (const Layer& layer : layers) {
    if (layer.name == name) return &layer;
  }
  return nullptr;
}

Image ExrFile::image(const std::string& name) const {
  const Layer* layer = find(name);
  const std::string which = name.empty() ? "the root layer" : "layer '" + name + "'";
  if (!layer) throw Error("the picture has no channels in " + which + "; expected R, G, B or Y");
  const std::vector<float>* r = find_plane(*layer, "R");
  const std::vector<float>* g = find_plane(*layer, "G");
  const std::vector<float>* b = find_plane(*layer, "B");
  const bool is_vector = find_plane(*layer, "X") != nullptr;  // whose Y is no luminance
  if (!r && !g && !b && !is_vector) r = g = b = find_plane(*layer, "Y");
  if (!r || !g || !b) throw Error("the picture has no R, G and B, nor Y, in " + which);
  Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = {(*r)[i], (*g)[i], (*b)[i]};
  }
  return image;
}

}  // namespace octolux
