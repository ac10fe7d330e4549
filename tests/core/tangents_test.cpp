// Tangents against differences of positions: meshes with and without texture coordinates, quadrics
// under an uneven map.
#include <gtest/gtest.h>

#include "core/frame.h"
#include "tests/core/light_cases.h"

namespace octolux {
namespace {

using namespace test;

TEST(Tangents, OfATriangleSolveItsTextureCoordinates) {
  TriangleMesh mesh;
  mesh.positions = {{1, 0, 2}, {4, 1, 2}, {0, 3, 5}};
  mesh.uvs = {{0.2f, 0.1f}, {0.9f, 0.3f}, {0.1f, 0.8f}};
  mesh.triangles = {{0, 1, 2}};
  const Tangents t = tangents(mesh, 0);
  for (int k = 1; k < 3; ++k) {
    const Vec2 d = mesh.uvs[static_cast<std::size_t>(k)] - mesh.uvs[0];
    const Vec3 across = t.dp_du * d.x + t.dp_dv * d.y;
    const Vec3 edge = mesh.positions[static_cast<std::size_t>(k)] - mesh.positions[0];
    EXPECT_NEAR(length(across - edge), 0, 1e-5);
  }
}

TEST(Tangents, WithoutTextureCoordinatesLieInThePlane) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  for (const bool degenerate : {false, true}) {
    if (degenerate) mesh.uvs = {{0, 0}, {1, 1}, {2, 2}};
    const Tangents t = tangents(mesh, 0);
    const Vec3 n = surface_point(mesh, 0, 0.3f, 0.3f).ng;
    EXPECT_NEAR(dot(t.dp_du, n), 0, 1e-6);
    EXPECT_NEAR(dot(t.dp_dv, n), 0, 1e-6);
    EXPECT_NEAR(dot(t.dp_du, t.dp_dv), 0, 1e-6);
    EXPECT_NEAR(length(t.dp_du), 1, 1e-6);
  }
}

TEST(Tangents, OfQuadricsAreDifferencesOfPositions) {
  const Affine map = affine({0.8, -0.5, 0.2, 0.3, 0.6, 1.1, -0.1, -0.2, 0.1, 0.3, 0.4, 0.5});
  // Neighbouring object positions around p along both coordinates.
  struct Case {
    Quadric::Kind kind;
    Vec3 p, next_u, next_v;
  };
  const float e = 1e-3f, c = std::cos(e), s = std::sin(e);
  const Vec3 on_sphere = normalize({0.48f, 0.36f, 0.8f});
  const float theta = std::acos(on_sphere.z) + e;
  const float phi = std::atan2(on_sphere.y, on_sphere.x);
  const Vec3 further{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                     std::cos(theta)};
  const auto turned = [&](Vec3 p) { return Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z}; };
  const Vec3 disk{0.3f, 0.4f, 0}, side{0.6f, 0.8f, 0.5f};
  for (const Case& k : {Case{Quadric::Kind::sphere, on_sphere, turned(on_sphere), further},
                        Case{Quadric::Kind::disk, disk, disk * (1 + e / 0.5f), turned(disk)},
                        Case{Quadric::Kind::cylinder, side, turned(side), side + Vec3{0, 0, e}}}) {
    const Quadric q{k.kind, map, inverse_of(map), false};
    const Tangents t = tangents(q, k.p);
    const SurfacePoint here = surface_point(q, k.p);
    const SurfacePoint u = surface_point(q, k.next_u), v = surface_point(q, k.next_v);
    // Second order: e / 2 relative; rounding: 2^-24 / e.
    const Vec3 du = (u.position - here.position) / (u.uv.x - here.uv.x);
    const Vec3 dv = (v.position - here.position) / (v.uv.y - here.uv.y);
    EXPECT_NEAR(length(t.dp_du - du), 0, 2e-3 * length(du)) << int(k.kind);
    EXPECT_NEAR(length(t.dp_dv - dv), 0, 2e-3 * length(dv)) << int(k.kind);
  }
}

TEST(Tangents, FrameFollowsThem) {
  const Vec3 n = normalize({0.2f, -0.3f, 0.9f}), tangent{1, 2, 0.5f};
  const Frame f = Frame::from_tangent(n, tangent);
  EXPECT_NEAR(dot(f.s, n), 0, 1e-6);
  EXPECT_NEAR(length(f.s), 1, 1e-6);
  EXPECT_GT(dot(f.s, tangent), 0);
  EXPECT_NEAR(dot(f.t, tangent), 0, 1e-6);
  EXPECT_NEAR(length(cross(f.s, f.t) - n), 0, 1e-6);
  const Frame any = Frame::from_tangent(n, n * 3), none = Frame::from_tangent(n, {0, 0, 0});
  EXPECT_EQ(none.s, Frame::from_normal(n).s);
  EXPECT_EQ(any.s, Frame::from_normal(n).s);
}

}  // namespace
}  // namespace octolux
