// Serialized meshes written here and read again: both versions, both widths, and bad ones.
#include "renderer/serialized_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <limits>

#include "core/error.h"
#include "tests/renderer/temp_files.h"

namespace octolux::test {
namespace {

template <typename T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

struct Content {
  int version = 4;
  bool doubles = false;
  std::uint32_t flags = 0x1 | 0x2 | 0x8;
  std::uint64_t vertices = 3;  // as the file says
  std::uint32_t last_index = 2;
  float z = 5;
};

/// A triangle at height z with normals, texture coordinates and colours.
std::string mesh(const Content& c) {
  std::string raw;
  append(raw, c.flags | (c.doubles ? 0x2000u : 0x1000u));
  if (c.version == 4) raw.append("name\0", 5);
  append(raw, c.vertices);
  append(raw, std::uint64_t{1});
  const auto number = [&](float x) { c.doubles ? append(raw, double(x)) : append(raw, x); };
  for (const float x : {0.f, 0.f, c.z, 1.f, 0.f, c.z, 0.f, 1.f, c.z}) number(x);
  if (c.flags & 1) {
    for (int i = 0; i < 9; ++i) number(i % 3 == 2 ? 1.f : 0.f);
  }
  if (c.flags & 2) {
    for (int i = 0; i < 6; ++i) number(0.125f * static_cast<float>(i));
  }
  if (c.flags & 8) {
    for (int i = 0; i < 9; ++i) number(0.1f * static_cast<float>(i));
  }
  for (const std::uint32_t i : {0u, 1u, c.last_index}) append(raw, i);

  uLongf size = compressBound(raw.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(raw.data()), raw.size());
  std::string result;
  append(result, std::uint16_t{0x041C});
  append(result, static_cast<std::uint16_t>(c.version));
  return result + packed.substr(0, size);
}

std::string file(const std::vector<Content>& meshes) {
  std::string bytes;
  std::vector<std::size_t> offsets;
  for (const Content& c : meshes) {
    offsets.push_back(bytes.size());
    bytes += mesh(c);
  }
  for (const std::size_t o : offsets) {
    if (meshes[0].version == 4) append(bytes, std::uint64_t{o});
    if (meshes[0].version == 3) append(bytes, static_cast<std::uint32_t>(o));
  }
  append(bytes, static_cast<std::uint32_t>(offsets.size()));
  return bytes;
}

TEST(SerializedFile, BothVersionsAndWidths) {
  for (const int version : {3, 4}) {
    for (const bool doubles : {false, true}) {
      Content first{.version = version, .doubles = doubles}, second = first;
      second.z = 7;
      const std::string bytes = file({first, second});
      for (const int index : {0, 1}) {
        const TriangleMesh m = read_serialized("a", bytes, index, true).mesh;
        ASSERT_EQ(m.positions.size(), 3u);
        EXPECT_EQ(m.positions[1], (Vec3{1, 0, index == 0 ? 5.f : 7.f}));
        EXPECT_EQ(m.normals.at(2), (Vec3{0, 0, 1}));
        EXPECT_EQ(m.uvs.at(1), (Vec2{0.25f, 0.375f}));
        EXPECT_EQ(m.triangles.at(0), (std::array<std::uint32_t, 3>{0, 1, 2}));
        ASSERT_EQ(m.attributes.size(), 1u);
        EXPECT_EQ(m.attributes[0].values.at(2).b, 0.1f * 8);
      }
    }
  }
}

TEST(SerializedFile, FlatFacesAndAbsentLists) {
  const SerializedMesh m = read_serialized("a", file({{.flags = 0x10}}), 0, false);
  EXPECT_TRUE(m.face_normals);
  EXPECT_TRUE(m.mesh.normals.empty());
  EXPECT_TRUE(m.mesh.uvs.empty());
  EXPECT_EQ(m.mesh.triangles.size(), 1u);
}

std::string complaint(const std::string& bytes, int index = 0, bool colors = false) {
  return message_of<Error>([&] { read_serialized("a", bytes, index, colors); });
}

TEST(SerializedFile, BadOnes) {
  const std::string good = file({{}, {}});
  EXPECT_EQ(complaint(good), "");
  EXPECT_EQ(complaint(good, 2), "a: the shape index 2 is out of range; the file has 2 meshes");
  EXPECT_EQ(complaint("ply\nformat"),
            "a: no serialized mesh: it does not begin with the bytes 1C 04");
  EXPECT_EQ(complaint(file({{.version = 5}})), "a: version 5; expected 3 or 4");
  EXPECT_EQ(complaint(file({{.last_index = 3}})),
            "a: mesh 0: triangle 0: the index 3 is out of range; there are 3 vertices");
  EXPECT_EQ(complaint(file({{.z = std::numeric_limits<float>::quiet_NaN()}})),
            "a: mesh 0: a number is not finite");
  EXPECT_EQ(complaint(file({{.vertices = 1000}})),
            "a: mesh 0: the data ends early; a count is too large or the file is cut off");
  EXPECT_EQ(complaint(file({{.vertices = std::uint64_t{1} << 40}})),
            "a: mesh 0: 1099511627776 vertices and 1 triangles do not fit the file");
  EXPECT_EQ(complaint(file({{.flags = 0}}), 0, true), "a: mesh 0: has no vertex colours");
  std::string broken = good;
  broken[4] = 'y';  // zlib's first byte
  EXPECT_EQ(complaint(broken), "a: mesh 0: broken zlib data (incorrect header check)");
}

TEST(SerializedFile, EveryTruncationIsNoticed) {
  const std::string good = file({{}, {.z = 6}});
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(complaint(good.substr(0, size)), "") << size;
  }
}

TEST(SerializedFile, EveryFlippedByteIsReadOrRefused) {
  const std::string good = file({{}});
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bytes = good;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
    complaint(bytes);  // does not crash
  }
}

}  // namespace
}  // namespace octolux::test
