// Pictures on disk: what is written comes back bit for bit, what others write is understood, what
// is broken says so. Foreign files (half, tiled, cropped) are made with OpenImageIO's writer, which
// shares no code with ours.
#include "core/image_io.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/rng.h"
#include "tests/temporary_folder.h"

namespace octolux {
namespace {

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

TEST(Exr, IsReadByOthersWithChromaticitiesOfRec709) {
  const TemporaryFolder folder;
  Image image(3, 2);
  image.at(2, 1) = {0.25f, -1, 1e6f};
  write_exr(folder / "a.exr", {3, 2, {rgb_layer("", image)}, {}});
  const auto input = OIIO::ImageInput::open(folder / "a.exr");
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
  const OIIO::ParamValue* primaries =
      spec.find_attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8));
  ASSERT_TRUE(primaries);
  const float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(primaries->get_float_indexed(i), rec709[i]);
  std::vector<float> pixels(3 * 2 * 3);
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data()));
  EXPECT_EQ(pixels[15], 0.25f);
  EXPECT_EQ(pixels[16], -1);
  EXPECT_EQ(pixels[17], 1e6f);
}

/// Writes `values` (width 5, channels interleaved) as `spec` says.
void write_foreign(const std::string& path, const OIIO::ImageSpec& spec,
                   const std::vector<float>& values) {
  const auto output = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(output && output->open(path, spec)) << OIIO::geterror();
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data())) << output->geterror();
  ASSERT_TRUE(output->close());
}

/// Multiples of 1/16 up to 15: exact in every format used here.
std::vector<float> exact_values(std::size_t count) {
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<float>(i % 240) / 16);
  return values;
}

void expect_pixels(const Image& image, const std::vector<float>& values) {
  ASSERT_EQ(image.pixels.size() * 3, values.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Rgb expected{values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    EXPECT_EQ(image.pixels[i], expected) << i;
  }
}

TEST(Exr, ReadsHalfWithADataWindowAwayFromZero) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(5, 4, 3, OIIO::TypeDesc::HALF);
  spec.x = -7;
  spec.y = 11;
  spec.full_x = -10;
  spec.full_width = 30;
  const std::vector<float> values = exact_values(5 * 4 * 3);
  write_foreign(folder / "half.exr", spec, values);
  const ExrFile file = read_exr(folder / "half.exr");
  EXPECT_EQ(file.width, 5);
  EXPECT_EQ(file.height, 4);
  expect_pixels(file.image(), values);
}

TEST(Exr, ReadsTiles) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(70, 50, 3, OIIO::TypeDesc::FLOAT);
  spec.tile_width = spec.tile_height = 32;
  spec.x = 5;
  const std::vector<float> values = exact_values(70 * 50 * 3);
  const auto output = OIIO::ImageOutput::create(folder / "tiled.exr");
  write_foreign(folder / "tiled.exr", spec, values);
  expect_pixels(read_exr(folder / "tiled.exr").image(), values);
}

TEST(Exr, ReadsUnsignedIntegersAndLuminanceAlone) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(4, 1, 1, OIIO::TypeDesc::UINT32);
  spec.channelnames = {"Y"};
  const auto output = OIIO::ImageOutput::create(folder / "y.exr");
  ASSERT_TRUE(output->open(folder / "y.exr", spec));
  const std::uint32_t values[4] = {0, 1, 77, 1u << 20};
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT32, values));
  ASSERT_TRUE(output->close());
  const Image image = read_exr(folder / "y.exr").image();
  for (int x = 0; x < 4; ++x) EXPECT_EQ(image.at(x, 0), Rgb(static_cast<float>(values[x])));
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "no Error";
}

void expect_error(const std::string& path, const std::string& part,
                  const std::function<void()>& call) {
  const std::string message = message_of(call);
  EXPECT_EQ(message.rfind(path + ": ", 0), 0u) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
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

TEST(Png, RoundsToTheNearestByteAndClamps) {
  const TemporaryFolder folder;
  Image image(256, 2);
  for (int x = 0; x < 256; ++x) {
    image.at(x, 0) = Rgb((static_cast<float>(x) + 0.49f) / 255);
    image.at(x, 1) = {-1, 2, std::numeric_limits<float>::quiet_NaN()};
  }
  write_png(folder / "a.png", image);
  const auto input = OIIO::ImageInput::open(folder / "a.png");
  ASSERT_TRUE(input);
  ASSERT_EQ(input->spec().nchannels, 3);
  std::vector<std::uint8_t> bytes(256 * 2 * 3);
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes.data()));
  for (int x = 0; x < 256; ++x) EXPECT_EQ(bytes[3 * x], x);
  EXPECT_EQ(bytes[3 * 256], 0);
  EXPECT_EQ(bytes[3 * 256 + 1], 255);
  EXPECT_EQ(bytes[3 * 256 + 2], 0);
}

TEST(ReadImage, DecodesBytesBySrgbUnlessTold) {
  const TemporaryFolder folder;
  const std::string path = folder / "grey.png";
  OIIO::ImageSpec spec(3, 1, 1, OIIO::TypeDesc::UINT8);
  write_foreign(path, spec, {0, 128.0f / 255, 1});
  const double linear = std::pow((128.0 / 255 + 0.055) / 1.055, 2.4);
  const double pow_error = 4 * 2.4 * std::numeric_limits<float>::epsilon();
  for (const Encoding encoding : {Encoding::automatic, Encoding::srgb}) {
    const Image image = read_image(path, encoding);
    EXPECT_EQ(image.at(0, 0), Rgb(0));
    EXPECT_NEAR(image.at(1, 0).g, linear, linear * pow_error);
    EXPECT_EQ(image.at(2, 0), Rgb(1));
  }
  EXPECT_EQ(read_image(path, Encoding::linear).at(1, 0), Rgb(128.0f / 255));
}

TEST(ReadImage, TakesFloatFilesAsLinearAndDropsAlpha) {
  const TemporaryFolder folder;
  const std::string path = folder / "rgba.exr";
  const OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::FLOAT);
  write_foreign(path, spec, {0.5f, 2, -1, 0.25f, 7, 8, 9, 0});
  const Image image = read_image(path, Encoding::automatic);
  EXPECT_EQ(image.at(0, 0), (Rgb{0.5f, 2, -1}));
  EXPECT_EQ(image.at(1, 0), (Rgb{7, 8, 9}));
}

TEST(ReadImage, KeepsTheColourOfTransparentPixels) {
  const TemporaryFolder folder;
  const std::string path = folder / "rgba.png";
  OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeDesc::UINT8);
  spec["oiio:UnassociatedAlpha"] = 1;
  write_foreign(path, spec, {1, 1, 0, 51.0f / 255});
  EXPECT_EQ(read_image(path, Encoding::automatic).at(0, 0), (Rgb{1, 1, 0}));
}

TEST(ReadImage, BadFilesNameThePathAndWhatWasExpected) {
  const TemporaryFolder folder;
  const std::string missing = folder / "missing.png";
  expect_error(missing, "no such file", [&] { read_image(missing, Encoding::automatic); });
  const std::string text = folder / "text.png";
  std::ofstream(text) << "not a picture";
  expect_error(text, "expected PNG", [&] { read_image(text, Encoding::automatic); });
}

}  // namespace
}  // namespace octolux
