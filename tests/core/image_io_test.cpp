// PNG files and textures: what we write others read, what others write (eight and sixteen bits,
// grey, alpha, float) is understood, what is broken says so. Others are stb_image_write, and for
// what it cannot write (16 bits, EXR) bytes made here.
#include "core/image_io.h"

#include <gtest/gtest.h>
#include <stb_image.h>
#include <stb_image_write.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>

#include "core/error.h"
#include "core/file_io.h"
#include "tests/core/error_testing.h"
#include "tests/temporary_folder.h"

namespace octolux {
namespace {

using test::expect_error;
using test::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

TEST(Png, RoundsToTheNearestByteAndClamps) {
  const TemporaryFolder folder;
  Image image(256, 2);
  for (int x = 0; x < 256; ++x) {
    image.at(x, 0) = Rgb((static_cast<float>(x) + 0.49f) / 255);
    image.at(x, 1) = {-1, 2, std::numeric_limits<float>::quiet_NaN()};
  }
  write_png(folder / "a.png", image);
  int width = 0, height = 0, channels = 0;
  stbi_uc* const bytes = stbi_load((folder / "a.png").c_str(), &width, &height, &channels, 0);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(width, 256);
  EXPECT_EQ(height, 2);
  ASSERT_EQ(channels, 3);
  for (int x = 0; x < 256; ++x) EXPECT_EQ(bytes[3 * x], x);
  EXPECT_EQ(bytes[3 * 256], 0);
  EXPECT_EQ(bytes[3 * 256 + 1], 255);
  EXPECT_EQ(bytes[3 * 256 + 2], 0);
  stbi_image_free(bytes);
}

/// 37 by 23 pixels, so that rows fill neither words nor buffers.
constexpr int kWidth = 37, kHeight = 23;

/// Bytes that a lossless format keeps.
Bytes pattern(int channels) {
  Bytes bytes;
  for (int i = 0; i < kWidth * kHeight * channels; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(i * i + i / 7));
  }
  return bytes;
}

/// What `pattern` means: grey spread, alpha dropped.
Image image_of(const Bytes& bytes, int channels) {
  Image image(kWidth, kHeight);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::uint8_t* p = &bytes[i * static_cast<std::size_t>(channels)];
    const auto channel = [&](int c) { return static_cast<float>(p[channels < 3 ? 0 : c]) / 255; };
    image.pixels[i] = {channel(0), channel(1), channel(2)};
  }
  return image;
}

TEST(ReadImage, KeepsTheBytesOfPngTgaAndBmp) {
  const TemporaryFolder folder;
  const auto write_png_of = [](const char* path, int channels, const void* bytes) {
    return stbi_write_png(path, kWidth, kHeight, channels, bytes, kWidth * channels);
  };
  for (int channels = 1; channels <= 4; ++channels) {
    const Bytes bytes = pattern(channels);
    const std::string png = folder / "a.png", tga = folder / "a.tga", bmp = folder / "a.bmp";
    ASSERT_TRUE(write_png_of(png.c_str(), channels, bytes.data()));
    ASSERT_TRUE(stbi_write_tga(tga.c_str(), kWidth, kHeight, channels, bytes.data()));
    ASSERT_TRUE(stbi_write_bmp(bmp.c_str(), kWidth, kHeight, channels, bytes.data()));
    for (const std::string& path : {png, tga, bmp}) {
      const Image image = read_image(path, Encoding::linear);
      ASSERT_EQ(image.width, kWidth) << path;
      ASSERT_EQ(image.height, kHeight) << path;
      EXPECT_EQ(image.pixels, image_of(bytes, channels).pixels) << path << ' ' << channels;
    }
  }
}

TEST(ReadImage, TellsFormatsByContent) {
  const TemporaryFolder folder;
  const Bytes bytes = pattern(3);
  const std::string path = folder / "a.exr";
  ASSERT_TRUE(stbi_write_bmp(path.c_str(), kWidth, kHeight, 3, bytes.data()));
  EXPECT_EQ(read_image(path, Encoding::linear).pixels, image_of(bytes, 3).pixels);
}

/// A JPEG of one colour holds that colour alone, up to the roundings of its transforms: half a step
/// of each of Y, Cb and Cr, at most 1.772 of them in a channel, and half a step of the result.
TEST(ReadImage, ReadsJpeg) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.jpg";
  Bytes bytes;
  for (int i = 0; i < kWidth * kHeight; ++i) bytes.insert(bytes.end(), {200, 100, 50});
  ASSERT_TRUE(stbi_write_jpg(path.c_str(), kWidth, kHeight, 3, bytes.data(), 100));
  const Image image = read_image(path, Encoding::linear);
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  const double tolerance = (0.5 + 1.772 * 0.5 + 0.5) / 255;
  for (const Rgb& c : image.pixels) {
    EXPECT_NEAR(c.r, 200.0 / 255, tolerance);
    EXPECT_NEAR(c.g, 100.0 / 255, tolerance);
    EXPECT_NEAR(c.b, 50.0 / 255, tolerance);
  }
}

/// Mantissas of eight bits beside a common exponent: exact for these.
TEST(ReadImage, TakesHdrAsLinear) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.hdr";
  Image image(kWidth, kHeight);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = Rgb{0.5f, 0.25f, 0.75f} * std::exp2(static_cast<float>(i % 20));
  }
  ASSERT_TRUE(stbi_write_hdr(path.c_str(), kWidth, kHeight, 3, &image.pixels.front().r));
  EXPECT_EQ(read_image(path, Encoding::automatic).pixels, image.pixels);
}

void append_u32(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

/// A chunk of PNG whose check sum, which stb does not look at, is 0.
void append_chunk(Bytes& png, const std::string& type, const Bytes& data) {
  append_u32(png, static_cast<std::uint32_t>(data.size()));
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  append_u32(png, 0);
}

/// One row of a grey PNG of 16 bits: a stored zlib block (RFC 1950, 1951), filter 0.
Bytes grey_png_16(const std::vector<std::uint16_t>& row) {
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  append_u32(header, static_cast<std::uint32_t>(row.size()));
  append_u32(header, 1);
  header.insert(header.end(), {16, 0, 0, 0, 0});
  append_chunk(png, "IHDR", header);
  const auto size = static_cast<std::uint8_t>(1 + 2 * row.size());
  Bytes data = {0x78, 0x01, 1, size, 0, static_cast<std::uint8_t>(~size), 0xff, 0};
  for (const std::uint16_t v : row) {
    data.insert(data.end(), {static_cast<std::uint8_t>(v >> 8), static_cast<std::uint8_t>(v)});
  }
  append_u32(data, 0);
  append_chunk(png, "IDAT", data);
  append_chunk(png, "IEND", {});
  return png;
}

void write_bytes(const std::string& path, std::span<const std::uint8_t> bytes) {
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

TEST(ReadImage, ReadsSixteenBits) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.png";
  const std::vector<std::uint16_t> row = {0, 1, 257, 40000, 65535};
  write_bytes(path, grey_png_16(row));
  const Image image = read_image(path, Encoding::linear);
  ASSERT_EQ(image.width, 5);
  for (int x = 0; x < 5; ++x) EXPECT_EQ(image.at(x, 0), Rgb(static_cast<float>(row[x]) / 65535));
}

TEST(ReadImage, DecodesIntegersBySrgbUnlessTold) {
  const TemporaryFolder folder;
  const std::string path = folder / "grey.png";
  const Bytes row = {0, 128, 255};
  ASSERT_TRUE(stbi_write_png(path.c_str(), 3, 1, 1, row.data(), 3));
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

TEST(ReadImage, TakesExrAsLinearAndDropsAlpha) {
  const TemporaryFolder folder;
  const std::string path = folder / "rgba.exr";
  const Layer root{"", {"R", "G", "B", "A"}, {{0.5f, 7}, {2, 8}, {-1, 9}, {0.25f, 0}}};
  write_exr(path, {2, 1, {root}, {}});
  const Image image = read_image(path, Encoding::automatic);
  EXPECT_EQ(image.at(0, 0), (Rgb{0.5f, 2, -1}));
  EXPECT_EQ(image.at(1, 0), (Rgb{7, 8, 9}));
  EXPECT_NE(read_image(path, Encoding::srgb).at(0, 0), image.at(0, 0));
}

TEST(ReadImage, KeepsTheColourOfTransparentPixels) {
  const TemporaryFolder folder;
  const std::string path = folder / "rgba.png";
  const Bytes pixel = {255, 255, 0, 51};
  ASSERT_TRUE(stbi_write_png(path.c_str(), 1, 1, 4, pixel.data(), 4));
  EXPECT_EQ(read_image(path, Encoding::automatic).at(0, 0), (Rgb{1, 1, 0}));
}

TEST(ReadImage, BadFilesNameThePathAndWhatWasExpected) {
  const TemporaryFolder folder;
  const auto expect_refusal = [](const std::string& path, const std::string& part) {
    expect_error(path, part, [&] { read_image(path, Encoding::automatic); });
  };
  expect_refusal(folder / "missing.png", "No such file");
  expect_refusal(folder.path(), "directory");
  std::ofstream(folder / "empty.png");
  expect_refusal(folder / "empty.png", "expected PNG");
  std::ofstream(folder / "text.png") << "not a picture";
  expect_refusal(folder / "text.png", "expected PNG");
  std::ofstream(folder / "big.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999 +X 99999\n";
  expect_refusal(folder / "big.hdr", "99999x99999");
  write_exr(folder / "depth.exr", {1, 1, {{"depth", {"Z"}, {{1}}}}, {}});
  expect_refusal(folder / "depth.exr", "expected R, G, B or Y");
}

/// Every format, cut anywhere behind the first bytes: an Error, not grey pixels, and no endless
/// loop.
TEST(ReadImage, EveryTruncationIsAnError) {
  const TemporaryFolder folder;
  const Bytes bytes = pattern(3);
  const std::vector<float> light(kWidth * kHeight * 3, 0.5f);
  stbi_write_png((folder / "a.png").c_str(), kWidth, kHeight, 3, bytes.data(), kWidth * 3);
  stbi_write_jpg((folder / "a.jpg").c_str(), kWidth, kHeight, 3, bytes.data(), 90);
  stbi_write_tga((folder / "a.tga").c_str(), kWidth, kHeight, 3, bytes.data());
  stbi_write_bmp((folder / "a.bmp").c_str(), kWidth, kHeight, 3, bytes.data());
  stbi_write_hdr((folder / "a.hdr").c_str(), kWidth, kHeight, 3, light.data());
  for (const char* name : {"a.png", "a.jpg", "a.tga", "a.bmp", "a.hdr"}) {
    const std::string whole = read_file(folder / name);
    ASSERT_NO_THROW(read_image(folder / name, Encoding::automatic)) << name;
    // A BMP's last row is padded; what is missing there is no pixel.
    for (std::streamsize size = 0; size + 4 < std::ssize(whole); size += 17) {
      std::ofstream(folder / "cut", std::ios::binary).write(whole.data(), size);
      EXPECT_THROW(read_image(folder / "cut", Encoding::automatic), Error) << name << ' ' << size;
    }
  }
}

}  // namespace
}  // namespace octolux
