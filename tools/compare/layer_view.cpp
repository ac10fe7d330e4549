// layer_view.h.
#include "tools/compare/layer_view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"

namespace octolux {
namespace {

constexpr char kVariance[] = "variance";
const std::vector<std::string> kRgb = {"R", "G", "B"};

bool is_exr(const std::string& path) {
  constexpr char kMagic[] = {'\x76', '\x2f', '\x31', '\x01'};
  char start[4] = {};
  std::ifstream(path, std::ios::binary).read(start, sizeof start);
  return std::equal(std::begin(start), std::end(start), std::begin(kMagic));
}

bool has(const Layer& layer, const std::string& channel) {
  return std::find(layer.channels.begin(), layer.channels.end(), channel) != layer.channels.end();
}

bool has_all(const Layer& layer, const std::vector<std::string>& channels) {
  return std::all_of(channels.begin(), channels.end(),
                     [&](const std::string& c) { return has(layer, c); });
}

/// The channels of `layer` that are compared, as they are named in it.
std::vector<std::string> compared_channels(const Layer& layer) {
  for (const auto& channels : {kRgb, std::vector<std::string>{"X", "Y", "Z"}}) {
    if (has_all(layer, channels)) return channels;
  }
  if (has(layer, "Y") && !has(layer, "R") && !has(layer, "X")) return {"Y", "Y", "Y"};
  std::vector<std::string> rest = layer.channels;
  std::erase(rest, "A");
  return rest;
}

std::vector<std::span<const float>> planes_of(const Layer& layer,
                                              const std::vector<std::string>& channels) {
  std::vector<std::span<const float>> planes;
  for (const std::string& channel : channels) {
    const auto i = std::find(layer.channels.begin(), layer.channels.end(), channel);
    planes.emplace_back(layer.planes[static_cast<std::size_t>(i - layer.channels.begin())]);
  }
  return planes;
}

std::string names_of(const std::vector<Layer>& layers) {
  std::vector<std::string> names;
  for (const Layer& layer : layers) names.push_back(layer_title(layer.name));
  return fmt::format("{}", fmt::join(names, ", "));
}

[[noreturn]] void fail_without(const NamedPicture& picture, const std::string& layer) {
  throw Error(fmt::format("{}: has no channels in {}; there are: {}", picture.name,
                          layer_title(layer), names_of(picture.file.layers)));
}

void add_variance(LayerView& view, const ExrFile& file) {
  const Layer* variance = file.find(kVariance);
  if (!variance || !has_all(*variance, view.channels)) return;
  const auto passes = file.attributes.number.find("octolux.passes");
  const bool said = passes != file.attributes.number.end();
  if (said && passes->second < 2) return;  // one pass has no spread
  if (said) view.passes = passes->second;
  view.variance = planes_of(*variance, view.channels);
}

}  // namespace

std::string layer_title(const std::string& layer) {
  return layer.empty() ? "the root layer" : "layer '" + layer + "'";
}

NamedPicture load_picture(const std::string& path, const std::vector<std::string>& layers) {
  if (is_exr(path)) {
    std::vector<std::string> wanted = layers;
    wanted.emplace_back(kVariance);
    return {path, read_exr(path, wanted)};
  }
  const Image image = read_image(path, Encoding::automatic);
  return {path, {image.width, image.height, {rgb_layer("", image)}, {}}};
}

std::optional<ExrFile> exr_header(const std::string& path) {
  if (!is_exr(path)) return std::nullopt;
  return read_exr_header(path);
}

void check_layers(const std::string& path, const std::vector<std::string>& layers) {
  const std::optional<ExrFile> header = exr_header(path);
  const NamedPicture picture{path, header ? *header : ExrFile{0, 0, {{"", kRgb, {}}}, {}}};
  for (const std::string& layer : layers) {
    if (!picture.file.find(layer)) fail_without(picture, layer);
  }
}

std::vector<std::string> common_layers(const std::string& reference,
                                       const std::vector<std::string>& others) {
  const auto layers_of = [](const std::string& path) {
    const std::optional<ExrFile> header = exr_header(path);
    if (!header) return std::vector<std::string>{""};
    std::vector<std::string> names;
    for (const Layer& layer : header->layers) names.push_back(layer.name);
    return names;
  };
  std::vector<std::string> common = layers_of(reference);
  std::erase(common, kVariance);
  for (const std::string& other : others) {
    const std::vector<std::string> theirs = layers_of(other);
    std::erase_if(common, [&](const std::string& name) {
      return std::find(theirs.begin(), theirs.end(), name) == theirs.end();
    });
  }
  return common;
}

LayerView view_layer(const NamedPicture& picture, const std::string& layer) {
  const ExrFile& file = picture.file;
  const Layer* found = file.find(layer);
  if (!found) fail_without(picture, layer);
  const std::vector<std::string> channels = compared_channels(*found);
  if (channels.empty()) {
    throw Error(fmt::format("{}: {} has alpha only; expected R, G and B, or Y", picture.name,
                            layer_title(layer)));
  }
  LayerView view;
  view.source = picture.name;
  view.layer = layer;
  view.width = file.width;
  view.height = file.height;
  view.channels = channels.front() == "Y" ? kRgb : channels;
  view.planes = planes_of(*found, channels);
  if (layer.empty()) add_variance(view, file);
  return view;
}

void check_comparable(const LayerView& reference, const LayerView& image) {
  if (image.width != reference.width || image.height != reference.height) {
    throw Error(fmt::format("{}: has {}x{} pixels; expected {}x{}, the size of {}", image.source,
                            image.width, image.height, reference.width, reference.height,
                            reference.source));
  }
  if (image.channels == reference.channels) return;
  throw Error(fmt::format("{}: {} has the channels {}; expected {}, those of {}", image.source,
                          layer_title(image.layer), fmt::join(image.channels, " "),
                          fmt::join(reference.channels, " "), reference.source));
}

float grey(const LayerView& view, std::size_t pixel) {
  if (view.channels == kRgb) {
    return luminance({view.planes[0][pixel], view.planes[1][pixel], view.planes[2][pixel]});
  }
  float sum = 0;
  for (const auto& plane : view.planes) sum += plane[pixel];
  return sum / static_cast<float>(view.planes.size());
}

}  // namespace octolux
