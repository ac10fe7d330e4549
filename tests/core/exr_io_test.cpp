// EXR files: what is written comes back bit for bit, what others write (half, tiled, cropped) is
// understood, what is broken says so. Others are OpenEXR's own simple interface, for half RGB.
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledRgbaFile.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/image_io.h"
#include "core/parallel.h"
#include "core/rng.h"
#include "tests/core/error_testing.h"
#include "tests/temporary_folder.h"

namespace octolux {
namespace {

using test::expect_error;
using test::TemporaryFolder;

/// Every kind of finite and infinite float, by random bits, and the special ones by name.
std::vector<float> all_kinds(std::size_t count, std::uint64_t index) {
  using limits = std::numeric_limits<float>;
  std::vector<float> values = {0.0f,
                               -0.0f,
                               limits::denorm_min(),
                               -1e-40f,
                               limits::min(),
                               limits::max(),
                               limits::lowest(),
                               limits::infinity(),
                               limits::quiet_NaN(),
                               1.0f / 3.0f};
  Rng rng(7, Stream::test, 0, index);
  while (values.size() < count) values.push_back(std::bit_cast<float>(rng.next()));
  values.resize(count);
  return values;
}

ExrFile sample_file() {
  ExrFile file;
  file.width = 13;
  file.height = 7;
  const std::vector<Layer> layers = {{"", {"R", "G", "B"}, {}},
                                     {"albedo", {"R", "G", "B"}, {}},
                                     {"depth", {"Z"}, {}},
                                     {"normal", {"X", "Y", "Z"}, {}}};
  std::uint64_t index = 0;
  for (Layer layer : layers) {
    for (std::size_t c = 0; c < layer.channels.size(); ++c) {
      layer.planes.push_back(all_kinds(13 * 7, index++));
    }
    file.layers.push_back(layer);
  }
  file.attributes.text = {{"sceneHash", "00ff00ff00ff00ff"}, {"empty", ""}, {"utf", "Größe µ"}};
  file.attributes.number = {{"passes", 12}, {"third", 1.0 / 3}, {"huge", 1e300}};
  return file;
}

TEST(Exr, KeepsEveryLayerBitForBit) {
  const TemporaryFolder folder;
  const ExrFile written = sample_file();
  write_exr(folder / "a.exr", written);
  const ExrFile read = read_exr(folder / "a.exr");
  ASSERT_EQ(read.width, written.width);
  ASSERT_EQ(read.height, written.height);
  ASSERT_EQ(read.layers.size(), written.layers.size());
  for (const Layer& layer : written.layers) {
    const Layer* other = read.find(layer.name);
    ASSERT_TRUE(other) << layer.name;
    ASSERT_EQ(other->channels, layer.channels);
    for (std::size_t c = 0; c < layer.planes.size(); ++c) {
      for (std::size_t i = 0; i < layer.planes[c].size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(other->planes[c][i]),
                  std::bit_cast<std::uint32_t>(layer.planes[c][i]))
            << layer.name << '.' << layer.channels[c] << " at " << i;
      }
    }
  }
}

/// Blocks of lines are unpacked in parallel: more of them than one, and a rest.
TEST(Exr, TallPicturesComeBackLineByLine) {
  const TemporaryFolder folder;
  ExrFile tall;
  tall.width = 3;
  tall.height = 1000;
  tall.layers.push_back({"", {"Y"}, {std::vector<float>(3000)}});
  for (std::size_t i = 0; i < 3000; ++i) tall.layers[0].planes[0][i] = static_cast<float>(i);
  write_exr(folder / "tall.exr", tall);
  for (const int threads : {1, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(read_exr(folder / "tall.exr").layers[0].planes[0], tall.layers[0].planes[0]);
  }
}

TEST(Exr, ReadsTheLayersAskedForOrTheHeaderAlone) {
  const TemporaryFolder folder;
  const ExrFile written = sample_file();
  write_exr(folder / "a.exr", written);
  const ExrFile some = read_exr(folder / "a.exr", {"", "depth", "nothing"});
  ASSERT_EQ(some.layers.size(), 2u);
  EXPECT_EQ(some.layers[1].name, "depth");
  EXPECT_EQ(std::bit_cast<std::uint32_t>(some.layers[1].planes[0][20]),
            std::bit_cast<std::uint32_t>(written.find("depth")->planes[0][20]));
  const ExrFile header = read_exr_header(folder / "a.exr");
  EXPECT_EQ(header.width, written.width);
  EXPECT_EQ(header.layers.size(), written.layers.size());
  EXPECT_TRUE(header.layers[0].planes.empty());
  EXPECT_EQ(header.attributes.number.at("passes"), 12);
}

TEST(Exr, KeepsAttributes) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", sample_file());
  const ExrAttributes read = read_exr(folder / "a.exr").attributes;
  for (const auto& [name, text] : sample_file().attributes.text) {
    EXPECT_EQ(read.text.at(name), text);
  }
  for (const auto& [name, number] : sample_file().attributes.number) {
    EXPECT_EQ(read.number.at(name), number);
  }
}

TEST(Exr, WhatWasReadCanBeWritten) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", sample_file());
  const ExrFile read = read_exr(folder / "a.exr");
  write_exr(folder / "b.exr", read);
  EXPECT_EQ(read_exr(folder / "b.exr").attributes.number, read.attributes.number);
}

TEST(Exr, IsReadByOthersWithChromaticitiesOfRec709) {
  const TemporaryFolder folder;
  Image image(3, 2);
  image.at(2, 1) = {0.25f, -1, 1024};
  write_exr(folder / "a.exr", {3, 2, {rgb_layer("", image)}, {}});
  Imf::RgbaInputFile input((folder / "a.exr").c_str());
  EXPECT_EQ(input.header().compression(), Imf::ZIP_COMPRESSION);
  EXPECT_EQ(input.header().channels()["R"].type, Imf::FLOAT);
  const Imf::Chromaticities& primaries = Imf::chromaticities(input.header());
  EXPECT_EQ(primaries.red, Imath::V2f(0.64f, 0.33f));
  EXPECT_EQ(primaries.green, Imath::V2f(0.30f, 0.60f));
  EXPECT_EQ(primaries.blue, Imath::V2f(0.15f, 0.06f));
  EXPECT_EQ(primaries.white, Imath::V2f(0.3127f, 0.3290f));
  std::vector<Imf::Rgba> pixels(3 * 2);
  input.setFrameBuffer(pixels.data(), 1, 3);
  input.readPixels(0, 1);
  EXPECT_EQ(pixels[5].r, 0.25f);
  EXPECT_EQ(pixels[5].g, -1.0f);
  EXPECT_EQ(pixels[5].b, 1024.0f);
}

/// Multiples of 1/16 below 15: exact in half.
Image exact_image(int width, int height) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float grey = static_cast<float>(i % 200) / 16;
    image.pixels[i] = {grey, grey + 1, grey + 2};
  }
  return image;
}

/// Has `output`, one of OpenEXR's writers of half RGB, take `image` as its data window.
template <class Output>
void set_pixels(Output& output, const Image& image, std::vector<Imf::Rgba>& pixels) {
  for (const Rgb& c : image.pixels) pixels.emplace_back(c.r, c.g, c.b);
  const Imath::V2i corner = output.dataWindow().min;
  const std::ptrdiff_t width = image.width;
  output.setFrameBuffer(pixels.data() - corner.x - corner.y * width, 1, image.width);
}

TEST(Exr, ReadsHalfWithADataWindowAwayFromZero) {
  const TemporaryFolder folder;
  const Image image = exact_image(5, 4);
  std::vector<Imf::Rgba> pixels;
  {
    const Imath::Box2i display({-10, 0}, {19, 3}), data({-7, 11}, {-3, 14});
    Imf::RgbaOutputFile output((folder / "half.exr").c_str(), display, data, Imf::WRITE_RGB);
    set_pixels(output, image, pixels);
    output.writePixels(image.height);
  }
  const ExrFile file = read_exr(folder / "half.exr");
  EXPECT_EQ(file.width, 5);
  EXPECT_EQ(file.height, 4);
  EXPECT_EQ(file.image().pixels, image.pixels);
}

TEST(Exr, ReadsTiles) {
  const TemporaryFolder folder;
  const Image image = exact_image(70, 50);
  std::vector<Imf::Rgba> pixels;
  {
    const Imath::Box2i window({5, 0}, {74, 49});
    Imf::TiledRgbaOutputFile output((folder / "tiled.exr").c_str(), 32, 32, Imf::ONE_LEVEL,
                                    Imf::ROUND_DOWN, window, window, Imf::WRITE_RGB);
    set_pixels(output, image, pixels);
    output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
  }
  EXPECT_EQ(read_exr(folder / "tiled.exr").image().pixels, image.pixels);
}

TEST(Exr, ReadsUnsignedIntegersAndLuminanceAlone) {
  const TemporaryFolder folder;
  std::uint32_t values[4] = {0, 1, 77, 1u << 20};
  {
    Imf::Header header(4, 1);
    header.channels().insert("Y", Imf::Channel(Imf::UINT));
    Imf::FrameBuffer buffer;
    buffer.insert("Y", {Imf::UINT, reinterpret_cast<char*>(values), sizeof(values[0]), 0});
    Imf::OutputFile output((folder / "y.exr").c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels();
  }
  const Image image = read_exr(folder / "y.exr").image();
  for (int x = 0; x < 4; ++x) EXPECT_EQ(image.at(x, 0), Rgb(static_cast<float>(values[x])));
}

TEST(Exr, BadFilesNameThePathAndWhatWasExpected) {
  const TemporaryFolder folder;
  const std::string missing = folder / "missing.exr";
  expect_error(missing, "no such file", [&] { read_exr(missing); });
  const std::string text = folder / "text.exr";
  std::ofstream(text) << "not a picture";
  expect_error(text, "expected", [&] { read_exr(text); });
  const std::string cut = folder / "cut.exr";
  write_exr(cut, sample_file());
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  expect_error(cut, "expected", [&] { read_exr(cut); });
  expect_error(folder.path(), "expected", [&] { read_exr(folder.path()); });
}

TEST(Exr, EveryTruncationIsAnErrorNeverACrash) {
  const TemporaryFolder folder;
  const std::string path = folder / "cut.exr";
  write_exr(path, sample_file());
  for (auto size = std::filesystem::file_size(path) - 1; size > 0;
       size -= std::min<std::uintmax_t>(size, 37)) {
    std::filesystem::resize_file(path, size);
    EXPECT_THROW(read_exr(path), Error) << size;
  }
}

TEST(Exr, AskingForALayerThatIsNotThereIsAnError) {
  const ExrFile file = sample_file();
  EXPECT_EQ(file.find("direct"), nullptr);
  EXPECT_THROW(file.image("direct"), Error);
  EXPECT_THROW(file.image("normal"), Error);
  EXPECT_EQ(file.image("albedo").width, 13);
}

}  // namespace
}  // namespace octolux
