// scenes.h: a room of 4 x 4 x 3 m, x and z from -2 to 2, y upward, open towards the camera (+z).
#include "tools/bench/scaling/scenes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "core/file_io.h"

namespace octolux {
namespace {

static_assert(std::endian::native == std::endian::little);  // as the PLY files say

constexpr double kSide = 4;        // [m] of the floor
constexpr double kLampHalf = 0.1;  // half a lamp's side, in units of the distance between lamps
constexpr double kPower = 200;     // [W] of all lamps, per channel

constexpr char kRoom[] = R"(<scene version="3.0.0">
  <sensor type="perspective">
    <string name="fov_axis" value="x"/>
    <float name="fov" value="50"/>
    <transform name="to_world">
      <lookat origin="0, 1.8, 6" target="0, 1.1, 0" up="0, 1, 0"/>
    </transform>
    <film type="hdrfilm">
      <integer name="width" value="256"/>
      <integer name="height" value="256"/>
    </film>
  </sensor>
  <bsdf type="diffuse" id="white"><rgb name="reflectance" value="0.7, 0.7, 0.7"/></bsdf>
  <bsdf type="diffuse" id="black"><rgb name="reflectance" value="0, 0, 0"/></bsdf>
)";

/// A wall of 4 x 4 m.
std::string wall(const std::string& turn, const std::string& place) {
  return fmt::format(
      "  <shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"2\"/>"
      "<rotate {}/><translate {}/></transform><ref id=\"white\"/></shape>\n",
      turn, place);
}

std::string walls() {
  return wall("x=\"1\" angle=\"90\"", "y=\"3\"") + wall("y=\"1\" angle=\"0\"", "y=\"1\" z=\"-2\"") +
         wall("y=\"1\" angle=\"90\"", "x=\"-2\" y=\"1\"") +
         wall("y=\"1\" angle=\"-90\"", "x=\"2\" y=\"1\"");
}

/// Squares 1 cm below the ceiling, in rows that are as long as they are many.
std::string lamps(std::int64_t count) {
  const auto columns = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const std::int64_t rows = (count + columns - 1) / columns;
  const double half = kLampHalf * kSide / std::sqrt(static_cast<double>(count));
  const double radiance =
      kPower / (std::numbers::pi * 4 * half * half * static_cast<double>(count));
  const auto place = [](std::int64_t i, std::int64_t of) {
    return kSide * ((static_cast<double>(i) + 0.5) / static_cast<double>(of) - 0.5);
  };
  std::string text;
  for (std::int64_t i = 0; i < count; ++i) {
    text += fmt::format(
        "  <shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"{:.6g}\"/>"
        "<rotate x=\"1\" angle=\"90\"/><translate x=\"{:.6g}\" y=\"2.99\" "
        "z=\"{:.6g}\"/></transform>"
        "<ref id=\"black\"/><emitter type=\"area\">"
        "<rgb name=\"radiance\" value=\"{:.6g}\"/></emitter></shape>\n",
        half, place(i % columns, columns), place(i / columns, rows), radiance);
  }
  return text;
}

/// Waves of a few centimetres.
float height(double x, double z) {
  return static_cast<float>(0.03 * std::sin(9 * x + 3 * z) + 0.02 * std::sin(13 * z - 7 * x) +
                            0.01 * std::sin(41 * x) * std::sin(37 * z));
}

template <typename T>
void append(std::vector<char>& bytes, const T& value) {
  const std::size_t end = bytes.size();
  bytes.resize(end + sizeof(T));
  std::memcpy(bytes.data() + end, &value, sizeof(T));
}

/// A square grid of `cells` x `cells`, two triangles each.
std::vector<char> wavy_floor(std::int32_t cells) {
  const std::int64_t across = cells + 1, squares = std::int64_t{cells} * cells;
  const std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      across * across, 2 * squares);
  std::vector<char> bytes(header.begin(), header.end());
  bytes.reserve(header.size() + static_cast<std::size_t>(12 * across * across + 26 * squares));
  for (std::int32_t row = 0; row <= cells; ++row) {
    for (std::int32_t column = 0; column <= cells; ++column) {
      const double x = kSide * column / cells - kSide / 2, z = kSide * row / cells - kSide / 2;
      for (const float v : {static_cast<float>(x), height(x, z), static_cast<float>(z)}) {
        append(bytes, v);
      }
    }
  }
  for (std::int32_t row = 0; row < cells; ++row) {
    for (std::int32_t column = 0; column < cells; ++column) {
      const std::int32_t a = row * (cells + 1) + column, b = a + 1, c = a + cells + 1, d = c + 1;
      for (const auto& [u, v, w] : {std::tuple{a, c, d}, std::tuple{a, d, b}}) {
        append(bytes, std::uint8_t{3});
        for (const std::int32_t corner : {u, v, w}) append(bytes, corner);
      }
    }
  }
  return bytes;
}

}  // namespace

GeneratedRoom::GeneratedRoom() {
  std::string pattern = (std::filesystem::temp_directory_path() / "octolux-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {
    throw Error(pattern + ": no temporary folder can be made here");
  }
  folder_ = pattern;
}

GeneratedRoom::~GeneratedRoom() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void GeneratedRoom::write(const std::string& floor, std::int64_t lamp_count) const {
  write_file(path(), kRoom + walls() + floor + lamps(lamp_count) + "</scene>\n");
}

WavyRoom::WavyRoom(std::int64_t triangles) {
  const auto cells = std::lround(std::sqrt(static_cast<double>(triangles) / 2));
  write_file(folder_ + "/floor.ply", wavy_floor(static_cast<std::int32_t>(std::max(1l, cells))));
  write(
      "  <shape type=\"ply\"><string name=\"filename\" value=\"floor.ply\"/>"
      "<ref id=\"white\"/></shape>\n",
      1);
}

LampRoom::LampRoom(std::int64_t count) { write(wall("x=\"1\" angle=\"-90\"", "y=\"0\""), count); }

}  // namespace octolux
