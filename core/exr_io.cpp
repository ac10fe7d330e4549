// EXR files through OpenEXR's frame buffer interface (image_io.h). The sole user of OpenEXR.
//
// A file is made in memory and written in one piece (file_io.h), because OpenEXR keeps quiet about
// a disk that fills up while it finishes a file. Pixels survive bit for bit: 32-bit floats, ZIP.
//
// Reading unpacks blocks of lines in parallel, each through an opening of the file of its own, so
// that ThreadLimit (parallel.h) governs it and OpenEXR's global thread pool stays unused.
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "core/check.h"
#include "core/error.h"
#include "core/file_io.h"
#include "core/image_io.h"
#include "core/parallel.h"

namespace octolux {
namespace {

/// More pixels than this are a broken header, not a picture.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

/// Lines unpacked at a time: a multiple of every compression's block of lines and of usual tiles.
constexpr std::int64_t kLinesPerChunk = 256;

std::string full_name(const Layer& layer, const std::string& channel) {
  return layer.name.empty() ? channel : layer.name + "." + channel;
}

Imf::Header make_header(const ExrFile& file) {
  Imf::Header header(file.width, file.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());  // OpenEXR's default is Rec.709
  for (const auto& [name, text] : file.attributes.text) {
    header.insert(name, Imf::StringAttribute(text));
  }
  for (const auto& [name, number] : file.attributes.number) {
    // OpenEXR's own, such as pixelAspectRatio, come back from a file as ours do.
    if (auto* own = header.findTypedAttribute<Imf::FloatAttribute>(name)) {
      own->value() = static_cast<float>(number);
    } else {
      header.insert(name, Imf::DoubleAttribute(number));
    }
  }
  return header;
}

/// The plane as OpenEXR wants it described: `origin` is the data window's corner, which the address
/// of pixel (0, 0) must make up for.
Imf::Slice slice_of(const float* plane, int width, Imath::V2i origin = {0, 0}) {
  const auto row = sizeof(float) * static_cast<std::size_t>(width);
  const std::int64_t shift = std::int64_t{origin.y} * static_cast<std::int64_t>(row) +
                             std::int64_t{origin.x} * static_cast<std::int64_t>(sizeof(float));
  const auto address = reinterpret_cast<std::intptr_t>(plane) - shift;
  return {Imf::FLOAT, reinterpret_cast<char*>(address), sizeof(float), row};
}

std::string encode(const ExrFile& file) {
  Imf::Header header = make_header(file);
  Imf::FrameBuffer buffer;
  const auto pixels = static_cast<std::size_t>(file.width) * static_cast<std::size_t>(file.height);
  for (const Layer& layer : file.layers) {
    OCTOLUX_CHECK(layer.channels.size() == layer.planes.size());
    for (std::size_t c = 0; c < layer.channels.size(); ++c) {
      OCTOLUX_CHECK(layer.planes[c].size() == pixels);
      const std::string name = full_name(layer, layer.channels[c]);
      OCTOLUX_CHECK(!header.channels().findChannel(name));
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      buffer.insert(name, slice_of(layer.planes[c].data(), file.width));
    }
  }
  Imf::StdOSStream stream;
  {
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(buffer);
    output.writePixels(file.height);
  }
  return stream.str();
}

ExrAttributes read_attributes(const Imf::Header& header) {
  ExrAttributes attributes;
  for (auto i = header.begin(); i != header.end(); ++i) {
    const Imf::Attribute& a = i.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a)) {
      attributes.text[i.name()] = text->value();
    } else if (const auto* number = dynamic_cast<const Imf::DoubleAttribute*>(&a)) {
      attributes.number[i.name()] = number->value();
    } else if (const auto* real = dynamic_cast<const Imf::FloatAttribute*>(&a)) {
      attributes.number[i.name()] = static_cast<double>(real->value());
    } else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&a)) {
      attributes.number[i.name()] = integer->value();
    }
  }
  return attributes;
}

/// Files list channels by the alphabet; people say R G B A. Other names stay in order.
int channel_rank(const std::string& channel) {
  const auto place = std::string("RGBA").find(channel);
  return channel.size() == 1 && place != std::string::npos ? static_cast<int>(place) : 4;
}

/// The layers of the file, with names only, each in order R G B A.
std::vector<Layer> layers_of(const std::string& path, const Imf::ChannelList& channels) {
  std::map<std::string, Layer> layers;
  for (auto i = channels.begin(); i != channels.end(); ++i) {
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1) {
      throw Error(path + ": channel '" + i.name() +
                  "' is subsampled; expected channels of full resolution");
    }
    const std::string name = i.name();
    const auto dot = name.rfind('.');
    Layer& layer = layers[dot == std::string::npos ? "" : name.substr(0, dot)];
    layer.channels.push_back(dot == std::string::npos ? name : name.substr(dot + 1));
  }
  std::vector<Layer> result;
  for (auto& [name, layer] : layers) {
    layer.name = name;
    std::stable_sort(
        layer.channels.begin(), layer.channels.end(),
        [](const auto& a, const auto& b) { return channel_rank(a) < channel_rank(b); });
    result.push_back(std::move(layer));
  }
  return result;
}

/// Header, attributes and the chosen layers with names only; none chosen: all.
ExrFile read_names(const std::string& path, const Imf::Header& header,
                   const std::vector<std::string>& chosen) {
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kMaxPixels / height) {
    throw Error(path + ": its header says " + std::to_string(width) + "x" + std::to_string(height) +
                " pixels; expected at least 1x1 and at most 2^28");
  }
  ExrFile file;
  file.width = static_cast<int>(width);
  file.height = static_cast<int>(height);
  file.attributes = read_attributes(header);
  file.layers = layers_of(path, header.channels());
  if (file.layers.empty()) throw Error(path + ": has no channels; expected R, G, B or Y");
  if (chosen.empty()) return file;
  std::erase_if(file.layers, [&](const Layer& layer) {
    return std::find(chosen.begin(), chosen.end(), layer.name) == chosen.end();
  });
  return file;
}

/// Gives every channel of `file` its plane.
void allocate_planes(ExrFile& file) {
  const auto pixels = static_cast<std::size_t>(file.width) * static_cast<std::size_t>(file.height);
  std::vector<std::vector<float>*> planes;
  for (Layer& layer : file.layers) {
    layer.planes.resize(layer.channels.size());
    for (std::vector<float>& plane : layer.planes) planes.push_back(&plane);
  }
  // Fresh memory is slow to touch for the first time.
  parallel_for_chunks(
      static_cast<std::int64_t>(planes.size()), 1,
      [&](std::int64_t i, std::int64_t, std::int64_t) { planes[i]->resize(pixels); });
}

ExrFile decode(const std::string& path, const std::vector<std::string>& chosen) {
  const Imf::InputFile first(path.c_str(), 0);
  const Imath::Box2i window = first.header().dataWindow();
  ExrFile file = read_names(path, first.header(), chosen);
  allocate_planes(file);
  Imf::FrameBuffer buffer;
  for (const Layer& layer : file.layers) {
    for (std::size_t c = 0; c < layer.channels.size(); ++c) {
      buffer.insert(full_name(layer, layer.channels[c]),
                    slice_of(layer.planes[c].data(), file.width, window.min));
    }
  }
  if (file.layers.empty()) return file;
  parallel_for_chunks(file.height, kLinesPerChunk,
                      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                        Imf::InputFile input(path.c_str(), 0);
                        input.setFrameBuffer(buffer);
                        input.readPixels(window.min.y + static_cast<int>(begin),
                                         window.min.y + static_cast<int>(end) - 1);
                      });
  return file;
}

void check_flat(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) throw Error(path + ": there is no such file");
  bool tiled = false, deep = false, multi_part = false;
  if (!Imf::isOpenExrFile(path.c_str(), tiled, deep, multi_part) || deep) {
    throw Error(path + ": is not a flat OpenEXR file; expected scan lines or tiles");
  }
}

/// read(), with OpenEXR's exceptions turned into Error.
template <class Read>
ExrFile guarded(const std::string& path, Read&& read) {
  check_flat(path);
  try {
    return read();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(path + ": cannot be read; expected a whole OpenEXR file: " + e.what());
  }
}

}  // namespace

void write_exr(const std::string& path, const ExrFile& file) {
  OCTOLUX_CHECK(file.width > 0 && file.height > 0);
  check_writable(path);
  write_file(path, encode(file));
}

ExrFile read_exr(const std::string& path, const std::vector<std::string>& layers) {
  return guarded(path, [&] { return decode(path, layers); });
}

ExrFile read_exr_header(const std::string& path) {
  return guarded(path,
                 [&] { return read_names(path, Imf::InputFile(path.c_str(), 0).header(), {}); });
}

}  // namespace octolux
