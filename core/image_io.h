// Pictures on disk: layered EXR (OpenEXR), PNG and texture files (stb). Everything written goes to
// a temporary file first and is renamed, so a picture on disk is always whole.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"

namespace octolux {

/// One layer of an EXR: "" is the root (R, G, B), others are "name.R" ...
struct Layer {
  std::string name;
  std::vector<std::string> channels;       // e.g. {"R", "G", "B"}, {"X", "Y", "Z"} or {"Z"}
  std::vector<std::vector<float>> planes;  // per channel, row-major
};

/// A layer of three channels R G B from an image.
Layer rgb_layer(std::string name, const Image& image);

/// Header attributes of our EXRs, by name.
struct ExrAttributes {
  std::map<std::string, std::string> text;
  std::map<std::string, double> number;
};

struct ExrFile {
  int width = 0;
  int height = 0;
  std::vector<Layer> layers;
  ExrAttributes attributes;

  /// The layer, or nullptr.
  const Layer* find(const std::string& name) const;
  /// The layer as an image; channels R G B in any order, or Y alone. Throws Error if it is not
  /// there.
  Image image(const std::string& layer = "") const;
};

/// 32-bit float, ZIP, Rec.709 chromaticities. Throws Error (with the path) if it cannot be written.
void write_exr(const std::string& path, const ExrFile& file);
/// Any scan-line or tiled single-part EXR, half, float or uint channels; of its layers those named
/// in `layers` that it has, or, with none named, all. In parallel. Throws Error.
ExrFile read_exr(const std::string& path, const std::vector<std::string>& layers = {});
/// The same without pixels: the planes are empty. Throws Error.
ExrFile read_exr_header(const std::string& path);

/// 8-bit PNG of display-referred values in [0, 1] (no colour conversion here; clamps, rounds).
void write_png(const std::string& path, const Image& image);

/// How a texture file's numbers become linear light.
enum class Encoding { automatic, srgb, linear };
/// PNG, JPEG, TGA, BMP, HDR or EXR, told apart by content; alpha is dropped, grey is spread.
/// automatic: HDR and EXR are linear, the others, of 8 or 16 bits, sRGB. Throws Error.
Image read_image(const std::string& path, Encoding encoding);

}  // namespace octolux
