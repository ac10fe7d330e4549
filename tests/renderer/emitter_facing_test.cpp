// Lamps are turned piece by piece; closed ones never.
#include "renderer/emitter_facing.h"

#include <gtest/gtest.h>

#include "core/rng.h"

namespace octolux {
namespace {

/// Adds a triangle with three vertices of its own.
void add(TriangleMesh& mesh, Vec3 a, Vec3 b, Vec3 c) {
  const auto i = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3 p : {a, b, c}) mesh.positions.push_back(p);
  mesh.triangles.push_back({i, i + 1, i + 2});
}

Vec3 winding_normal(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Vec3 a = mesh.positions[t[0]];
  return normalize(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
}

TEST(EmitterFacing, EachOpenPieceOnItsOwn) {
  TriangleMesh mesh;  // panels at x = -1 and x = 1, both facing +x; the target lies between them
  for (const float x : {-1.0f, 1.0f}) {
    add(mesh, {x, 0, 0}, {x, 1, 0}, {x, 0, 1});
    add(mesh, {x, 1, 0}, {x, 1, 1}, {x, 0, 1});
  }
  mesh.normals.assign(mesh.positions.size(), {1, 0, 0});
  EXPECT_EQ(face_point(mesh, {0, 0.5f, 0.5f}), 2u);
  for (std::size_t t = 0; t < 4; ++t) {
    const Vec3 expected{t < 2 ? 1.0f : -1.0f, 0, 0};
    EXPECT_EQ(winding_normal(mesh, t), expected);
    for (const std::uint32_t i : mesh.triangles[t]) EXPECT_EQ(mesh.normals[i], expected);
  }
  EXPECT_EQ(face_point(mesh, {0, 0.5f, 0.5f}), 0u);
}

TEST(EmitterFacing, VertexNormalsSayWhichSideIsFront) {
  TriangleMesh mesh;
  add(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.normals.assign(3, {0, 0, -1});
  EXPECT_EQ(face_point(mesh, {0, 0, -5}), 0u);
  EXPECT_EQ(face_point(mesh, {0, 0, 5}), 1u);
  for (const Vec3 n : mesh.normals) EXPECT_EQ(n, (Vec3{0, 0, 1}));
}

TEST(EmitterFacing, ClosedPiecesStay) {
  // Tetrahedra whose area vectors cancel but for rounding, whose sign is random.
  for (std::uint64_t i = 0; i < 100; ++i) {
    Rng rng(1, Stream::test, 0, i);
    Vec3 p[4];
    for (Vec3& corner : p) {
      const Vec2 xy = rng.uniform2();
      corner = {5 + xy.x, xy.y, rng.uniform()};
    }
    TriangleMesh mesh;
    add(mesh, p[0], p[1], p[2]);
    add(mesh, p[0], p[3], p[1]);
    add(mesh, p[1], p[3], p[2]);
    add(mesh, p[2], p[3], p[0]);
    EXPECT_EQ(face_point(mesh, {0, 0, 0}), 0u);
  }
}

}  // namespace
}  // namespace octolux
