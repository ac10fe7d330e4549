// Layers in memory, and PNG and texture files through OpenImageIO (image_io.h). The sole user of
// OpenImageIO. Thread-safe.
#include "core/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "core/check.h"
#include "core/error.h"
#include "core/file_io.h"

namespace octolux {
namespace {

/// sRGB's curve, from display value to linear light (IEC 61966-2-1).
float srgb_to_linear(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

std::uint8_t to_byte(float v) {
  if (!(v > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::lround(std::min(v, 1.0f) * 255));
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

[[noreturn]] void fail_to_read(const std::string& path, const std::string& why) {
  throw Error(path + ": cannot be read as a picture; expected PNG, JPEG, TGA, BMP, HDR or EXR: " +
              one_line(why));
}

const std::vector<float>* find_plane(const Layer& layer, const std::string& channel) {
  const auto i = std::find(layer.channels.begin(), layer.channels.end(), channel);
  return i == layer.channels.end() ? nullptr : &layer.planes[i - layer.channels.begin()];
}

bool is_linear(Encoding encoding, OIIO::TypeDesc format) {
  return encoding == Encoding::linear ||
         (encoding == Encoding::automatic && format.is_floating_point());
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

void write_png(const std::string& path, const Image& image) {
  OCTOLUX_CHECK(image.width > 0 && image.height > 0);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const Rgb& p : image.pixels) {
    for (int c = 0; c < 3; ++c) bytes.push_back(to_byte(p[c]));
  }
  std::vector<unsigned char> file;
  OIIO::Filesystem::IOVecOutput memory(file);
  const auto output = OIIO::ImageOutput::create("png");
  const OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  if (!output || !output->set_ioproxy(&memory) || !output->open("png", spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) || !output->close()) {
    throw Error(path + ": cannot be encoded as PNG: " +
                one_line(output ? output->geterror() : OIIO::geterror()));
  }
  write_file(path, {reinterpret_cast<const char*>(file.data()), file.size()});
}

Image read_image(const std::string& path, Encoding encoding) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) throw Error(path + ": there is no such file");
  OIIO::ImageSpec wanted;
  wanted["oiio:UnassociatedAlpha"] = 1;  // colour as stored, not multiplied by alpha
  const auto input = OIIO::ImageInput::open(path, &wanted);
  if (!input) fail_to_read(path, OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const int channels = spec.nchannels >= 3 ? 3 : 1;
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1) {
    fail_to_read(path, "it is not a flat picture of at least 1x1 pixels");
  }
  Image image(spec.width, spec.height);
  std::vector<float> values(image.pixels.size() * channels);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data())) {
    fail_to_read(path, input->geterror());
  }
  if (!is_linear(encoding, spec.format)) {
    std::transform(values.begin(), values.end(), values.begin(), srgb_to_linear);
  }
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float* v = &values[i * channels];
    image.pixels[i] = channels == 3 ? Rgb{v[0], v[1], v[2]} : Rgb(v[0]);
  }
  return image;
}

}  // namespace octolux
