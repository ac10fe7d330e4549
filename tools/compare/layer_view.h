// What is compared: one layer of a picture, as planes of numbers that somebody else owns, with what
// is known of their noise. Pictures come from files (load_picture) or from memory (any ExrFile).
//
// Errors are one line each: other sizes, missing layers, missing channels.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/image_io.h"

namespace octolux {

/// A picture with the name it goes by in messages.
struct NamedPicture {
  std::string name;
  ExrFile file;
};

/// Layers R G B, X Y Z, or whatever else there is; a lone Y is spread to R G B; alpha is left out.
struct LayerView {
  std::string source;  // the picture's name
  std::string layer;   // "": the root
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<std::span<const float>> planes;    // per channel, row-major
  std::vector<std::span<const float>> variance;  // of the planes' values; empty: not known
  double passes =
      std::numeric_limits<double>::infinity();  // independent ones behind the variance; infinite:
                                                // not said, so the variance counts as exact

  std::size_t pixels() const { return planes.empty() ? 0 : planes.front().size(); }
};

/// "the root layer" or "layer 'NAME'".
std::string layer_title(const std::string& layer);

/// Reads an EXR's `layers` (with the layer `variance`, if it has one), or another picture format as
/// a root layer. Throws Error.
NamedPicture load_picture(const std::string& path, const std::vector<std::string>& layers);

/// An EXR's header (its layers have no pixels); empty for another format. Throws Error.
std::optional<ExrFile> exr_header(const std::string& path);

/// Throws Error unless the picture has all of `layers`, by its header.
void check_layers(const std::string& path, const std::vector<std::string>& layers);

/// The layers of `reference` that every other picture has too, `variance` excepted. From headers
/// only. Throws Error.
std::vector<std::string> common_layers(const std::string& reference,
                                       const std::vector<std::string>& others);

/// The layer of `picture`, which must outlive the view. Variance is known of the root layer only.
/// Throws Error if there is no such layer or it has no channels to compare.
LayerView view_layer(const NamedPicture& picture, const std::string& layer = "");

/// Throws Error unless `image` has the size and the channels of `reference`.
void check_comparable(const LayerView& reference, const LayerView& image);

/// Luminance of R G B, else the mean of the channels, for pictures of differences.
float grey(const LayerView& view, std::size_t pixel);

}  // namespace octolux
