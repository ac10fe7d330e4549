// PLY files in all three formats, and what is said about bad ones.
#include "renderer/ply_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/error.h"
#include "tests/renderer/temp_files.h"

namespace octolux::test {
namespace {

/// Values in the given byte order, one after the other.
class Bytes {
 public:
  explicit Bytes(bool big) : swap_(big != (std::endian::native == std::endian::big)) {}
  template <typename T>
  Bytes& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (swap_) std::reverse(std::begin(raw), std::end(raw));
    text.append(raw, sizeof(T));
    return *this;
  }
  std::string text;

 private:
  bool swap_;
};

std::string header(const std::string& format, int vertices = 4, int faces = 2) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " +
         std::to_string(vertices) +
         "\nproperty float x\nproperty double y\nproperty float z\n"
         "property float nx\nproperty float ny\nproperty float nz\n"
         "property float s\nproperty float t\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
         "element face " +
         std::to_string(faces) +
         "\nproperty list uchar int vertex_indices\nproperty float weight_0\n"
         "element edge 1\nproperty short a\nproperty list uint char b\nend_header\n";
}

constexpr float kSquare[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

std::string text_file() {
  std::string body;
  for (const auto& [x, y] : kSquare) {
    body += std::to_string(x) + " " + std::to_string(y) + " +2.5e0 0 0 1 0.25 " +
            std::to_string(y) + " 255 0 188\r\n";
  }
  return header("ascii") + body + "3 0 1 2 0.5\n3 0 2 3\n1\n-7 2 1 2\n";
}

std::string binary_file(bool big) {
  Bytes body(big);
  for (const auto& [x, y] : kSquare) {
    body.add(x).add(double(y)).add(2.5f).add(0.0f).add(0.0f).add(1.0f).add(0.25f).add(y);
    body.add('\xff').add('\0').add('\xbc');
  }
  body.add('\3').add(0).add(1).add(2).add(0.5f).add('\3').add(0).add(2).add(3).add(1.0f);
  body.add(short(-7)).add(2u).add('\1').add('\2');
  return header(big ? "binary_big_endian" : "binary_little_endian") + body.text;
}

TEST(PlyFile, TheThreeFormatsSayTheSame) {
  for (const std::string& bytes : {text_file(), binary_file(false), binary_file(true)}) {
    const PlyMesh file = read_ply("a.ply", bytes, {"vertex_color", "face_weight"});
    const TriangleMesh& mesh = file.mesh;
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[2], (Vec3{1, 1, 2.5f}));
    EXPECT_EQ(mesh.normals[3], (Vec3{0, 0, 1}));
    EXPECT_EQ(mesh.uvs[2], (Vec2{0.25f, 1}));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
    ASSERT_EQ(mesh.attributes.size(), 2u);
    EXPECT_EQ(mesh.attributes[0].name, "vertex_color");
    EXPECT_FALSE(mesh.attributes[0].per_face);
    const Rgb c = mesh.attributes[0].values.at(3);
    EXPECT_EQ(c.r, 1);
    EXPECT_EQ(c.g, 0);
    EXPECT_NEAR(c.b, 0.5029f, 1e-4f);  // sRGB's 188
    EXPECT_EQ(mesh.attributes[1].name, "face_weight");
    EXPECT_TRUE(mesh.attributes[1].per_face);
    EXPECT_EQ(mesh.attributes[1].values.at(0), Rgb(0.5f));
    EXPECT_EQ(file.warnings.size(), 1u);  // the element 'edge'
  }
}

std::string small(const std::string& body,
                  const std::string& face = "list uchar int vertex_index") {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty " +
         face + "\nend_header\n" + body;
}
const std::string kVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(PlyFile, PolygonsAreCut) {
  const TriangleMesh mesh = read_ply("a.ply", small(kVertices + "4 0 1 2 3"), {}).mesh;
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.attributes.empty());
}

std::string complaint(const std::string& bytes, const std::vector<std::string>& attributes = {}) {
  return message_of<Error>([&] { read_ply("a.ply", bytes, attributes); });
}

TEST(PlyFile, BadHeaders) {
  EXPECT_EQ(complaint(""), "a.ply:1: no PLY file: the first line must be 'ply'");
  EXPECT_EQ(complaint("P6\n1 1\n"), "a.ply:1: no PLY file: the first line must be 'ply'");
  EXPECT_EQ(complaint("ply\nformat ascii 1.0\n"),
            "a.ply:3: the file ends inside the header (no 'end_header')");
  EXPECT_NE(complaint("ply\nformat asci 1.0\nend_header\n").find("a.ply:2: unknown PLY format"),
            std::string::npos);
  EXPECT_EQ(complaint("ply\nend_header\n"), "a.ply:2: the header has no line 'format'");
  EXPECT_EQ(complaint("ply\nformat ascii 1.0\nelement vertex -1\n"), "a.ply:3: '-1' is no count");
  EXPECT_EQ(complaint("ply\nformat ascii 1.0\nproperty float x\n"),
            "a.ply:3: a 'property' before the first 'element'");
  EXPECT_NE(complaint("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n")
                .find("unknown PLY type 'real'"),
            std::string::npos);
}

TEST(PlyFile, BadBodies) {
  EXPECT_EQ(complaint(small("0 0 0\n1 0 0\n1 1 0\n0 1 0\n")),
            "a.ply:14: face 0 of 1: the file ends here");
  EXPECT_EQ(complaint(small("0 0 0\n1 0 0\n1 zero 0\n0 1 0\n3 0 1 2")),
            "a.ply:12: vertex 2 of 4: 'y' is not a number");
  EXPECT_EQ(complaint(small("0 0 0\n1 0 0\n1 nan 0\n0 1 0\n3 0 1 2")),
            "a.ply:12: vertex 2 of 4: 'y' is not a finite number");
  EXPECT_EQ(complaint(small("0 0 0\n1 0 0\n1 1e99 0\n0 1 0\n3 0 1 2")),
            "a.ply:12: vertex 2 of 4: 'y' is not a finite number");
  EXPECT_EQ(complaint(small(kVertices + "3 0 1")), "a.ply:14: face 0 of 1: the file ends here");
  EXPECT_EQ(complaint(small(kVertices + "3 0 1 4")),
            "a.ply: face 0: the index 4 is out of range; the file has 4 vertices");
  EXPECT_EQ(complaint(small(kVertices + "3 0 1 -1")),
            "a.ply:14: face 0 of 1: -1 is no index of a vertex");
  EXPECT_EQ(complaint(small(kVertices + "3 0 1 1.5")),
            "a.ply:14: face 0 of 1: 1.5 is no index of a vertex");
  EXPECT_EQ(complaint(small(kVertices + "3 0 1 2\n3 0 2 3")),
            "a.ply:15: there is data behind the last element; a count is too small");
  EXPECT_EQ(complaint(small(kVertices + "2 0 1")), "a.ply:14: holds no faces");
  EXPECT_EQ(complaint(small(kVertices + "0", "int other")),
            "a.ply:13: face 0 of 1: expected a property list 'vertex_indices'");
}

TEST(PlyFile, TruncatedBinaryFilesAreNoticedAnywhere) {
  const std::string whole = binary_file(false);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(complaint(whole.substr(0, size)), "") << size;
  }
  EXPECT_EQ(complaint(whole), "");
}

TEST(PlyFile, CountsThatNoFileCouldHoldAskForNoMemory) {
  for (const std::string count : {"1000000000", "99999999999999", "18446744073709551615"}) {
    std::string bytes = text_file();
    bytes.replace(bytes.find("vertex 4"), 8, "vertex " + count);
    EXPECT_NE(complaint(bytes), "");
  }
}

TEST(PlyFile, MissingAttributesAreNamed) {
  const std::string message = complaint(text_file(), {"vertex_colour"});
  EXPECT_NE(message.find("unknown mesh attribute 'vertex_colour'"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean 'vertex_color'"), std::string::npos) << message;
}

}  // namespace
}  // namespace octolux::test
