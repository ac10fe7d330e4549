// Reading OBJ files: every way to write the same thing reads the same, and everything wrong is an
// error that names its line.
#include "renderer/obj_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "tests/renderer/temp_files.h"

namespace octolux {
namespace {

const char kSquare[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

ObjFile read(const std::string& text) {
  const test::TempFolder folder;
  return read_obj_file(folder.write("a.obj", text));
}

/// The error's text from the line number on.
std::string error_of(const std::string& text) {
  const std::string message = test::message_of<Error>([&] { read(text); });
  const std::size_t at = message.find("a.obj:");
  return at == std::string::npos ? message : message.substr(at + 6);
}

void expect_triangle(const ObjTriangle& t, int a, int b, int c) {
  EXPECT_EQ(t.corners[0].position, a);
  EXPECT_EQ(t.corners[1].position, b);
  EXPECT_EQ(t.corners[2].position, c);
}

TEST(ObjFile, PositiveAndNegativeIndicesAgree) {
  const std::string vertices = std::string(kSquare) + "vt 0 0\nvt 1 0\nvn 0 0 1\n";
  const ObjFile a = read(vertices + "f 1/1/1 2/2/1 4//1\n");
  const ObjFile b = read(vertices + "f -4/-2/-1 -3/-1/-1 -1//-1\n");
  ASSERT_EQ(a.triangles.size(), 1u);
  ASSERT_EQ(b.triangles.size(), 1u);
  EXPECT_EQ(a.triangles[0].corners, b.triangles[0].corners);
  EXPECT_EQ(a.triangles[0].corners[2], (ObjCorner{3, -1, 0}));
}

TEST(ObjFile, LineBreaksCommentsAndContinuationsChangeNothing) {
  const ObjFile plain = read(std::string(kSquare) + "usemtl a b\nf 1 2 3 4\n");
  const ObjFile crlf = read(
      "# c\r\nv 0 0 0 # one\r\n\tv 1 0 0\r\n\r\nv +1 1.0 0e0 1 \r\nv 0 1 0 .5 .5 .5\r\n"
      "usemtl  a b \r\nf 1 2 \\\r\n  3 4 # all\r\n");
  const ObjFile cr = read("v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rusemtl a b\rf 1 2 3 4");
  for (const ObjFile* f : {&plain, &crlf, &cr}) {
    EXPECT_EQ(f->positions, plain.positions);
    ASSERT_EQ(f->triangles.size(), 2u);
    expect_triangle(f->triangles[0], 0, 1, 2);
    expect_triangle(f->triangles[1], 0, 2, 3);
    EXPECT_EQ(f->material_names, std::vector<std::string>{"a b"});
    EXPECT_TRUE(f->warnings.empty());
  }
  EXPECT_NE(plain.hash, cr.hash);
}

TEST(ObjFile, IndicesMayPointForward) {
  const ObjFile file = read(std::string("f 1 2 3\n") + kSquare);
  expect_triangle(file.triangles.at(0), 0, 1, 2);
}

TEST(ObjFile, LargePolygons) {
  std::string text, face = "f";
  for (int i = 0; i < 1000; ++i) {  // more corners than tinyobjloader's counter of a byte holds
    const double phi = 2 * 3.14159265358979 * i / 1000;
    text += fmt::format("v {} 0 {}\n", std::cos(phi), std::sin(phi));
    face += fmt::format(" {}", i + 1);
  }
  EXPECT_EQ(read(text + face + "\n").triangles.size(), 998u);
}

TEST(ObjFile, MaterialsPerTriangle) {
  const ObjFile file =
      read(std::string(kSquare) +
           "f 1 2 3\nusemtl x\nf 1 2 3\nusemtl y\no q\nf 1 2 3\nusemtl x\nf 1 2 3\n");
  EXPECT_EQ(file.material_names, (std::vector<std::string>{"x", "y"}));
  ASSERT_EQ(file.triangles.size(), 4u);
  const int expected[] = {-1, 0, 1, 0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(file.triangles[i].material, expected[i]);
}

TEST(ObjFile, IgnoredStatementsAreSaidOnce) {
  const ObjFile file =
      read(std::string(kSquare) + "p 1\np 2\nl 1 2\ncurv 0 1\ns off\ng\nf 1 2 3\nf 1 2\n");
  ASSERT_EQ(file.warnings.size(), 4u);
  EXPECT_NE(file.warnings[0].find("a.obj:8: 'curv' is ignored"), std::string::npos);
  EXPECT_NE(file.warnings[1].find("a.obj:7: 'l' (lines) is ignored"), std::string::npos);
  EXPECT_NE(file.warnings[2].find("a.obj:5: 'p' (points) is ignored"), std::string::npos);
  EXPECT_NE(file.warnings[3].find("1 faces with fewer than 3 corners"), std::string::npos);
}

TEST(ObjFile, BadNumbersNameTheirLine) {
  for (const char* bad : {"nan 0 0", "0 inf 0", "0 -inf 0", "0 0 1e39", "0 0 1.#IND", "0 0",
                          "a b c", "1,0 2,0 3,0", "0 0 --1", "0 0 1e", ""}) {
    SCOPED_TRACE(bad);
    EXPECT_EQ(error_of(std::string("# a comment\n\nv 0 0 0\nv ") + bad + "\nf 1 1 1\n"),
              "4: a vertex needs three finite numbers");
  }
  EXPECT_EQ(error_of(std::string(kSquare) + "vn 0 nan 0\nf 1 2 3"),
            "5: a vertex normal needs three finite numbers");
  EXPECT_EQ(error_of(std::string(kSquare) + "vt x\nf 1 2 3"),
            "5: a texture coordinate needs one to three finite numbers");
  // Lines that were joined are counted; a statement is at its first line.
  EXPECT_EQ(error_of("v 0 \\\n0 \\\n0\nv 1 0 \\\n nan\n"),
            "4: a vertex needs three finite numbers");
}

TEST(ObjFile, SlashesWithNothingBehindThemCountNothing) {
  const ObjFile file = read(std::string(kSquare) + "vt 0 0\nvn 0 0 1\nf 1/1/ 2// 3/\t4/1/1 # /\n");
  ASSERT_EQ(file.triangles.size(), 2u);
  EXPECT_EQ(file.triangles[0].corners[0].tex_coord, 0);
  EXPECT_EQ(file.triangles[0].corners[0].normal, -1);
  EXPECT_EQ(file.triangles[0].corners[1].tex_coord, -1);
  EXPECT_EQ(file.triangles[0].corners[2].normal, -1);
}

TEST(ObjFile, BadIndicesNameTheirLine) {
  const std::string v = std::string(kSquare) + "vt 0 0\nvn 0 0 1\n";
  EXPECT_EQ(error_of(v + "f 1 2 5\nf 1 2 3\n"), "7: face index 5 is no vertex (the file has 4)");
  EXPECT_EQ(error_of(v + "f 1 2 -5\n"), "7: face index -5 is no vertex (4 read so far)");
  EXPECT_EQ(error_of(v + "f 0 1 2\n"), "7: face index 0 is no vertex (4 read so far)");
  EXPECT_EQ(error_of(v + "f a b c\n"), "7: face index 0 is no vertex (4 read so far)");
  EXPECT_EQ(error_of(v + "f 1/2 2/1 3/1\n"),
            "7: face index 2 is no texture coordinate (the file has 1)");
  EXPECT_EQ(error_of(v + "f 1//-2 2//1 3//1\n"),
            "7: face index -2 is no vertex normal (1 read so far)");
  EXPECT_EQ(error_of(v + "f 1/0/1 2/1/1 3/1/1\n"), "7: a face index must be a number other than 0");
  EXPECT_EQ(error_of(v + "f 1//x 2//1 3//1\n"), "7: a face index must be a number other than 0");
}

TEST(ObjFile, NothingToShow) {
  EXPECT_NE(error_of("").find("holds no faces"), std::string::npos);
  EXPECT_NE(error_of(kSquare).find("holds no faces"), std::string::npos);
  EXPECT_NE(error_of(std::string(300, '\0') + "\x89PNG\n").find("holds no faces"),
            std::string::npos);
  const test::TempFolder folder;
  EXPECT_NE(test::message_of<Error>([&] {
              read_obj_file(folder.path("no.obj"));
            }).find("no.obj: cannot be read: No such file"),
            std::string::npos);
  EXPECT_NE(test::message_of<Error>([&] { read_obj_file(folder.path("")); }).find("a directory"),
            std::string::npos);
}

}  // namespace
}  // namespace octolux
