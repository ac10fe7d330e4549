// Triangulation: every simple polygon is covered exactly once, whatever its shape, size and place.
#include "renderer/polygon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/constants.h"
#include "core/rng.h"

namespace octolux {
namespace {

struct Area {
  double nx = 0, ny = 0, nz = 0;
};

Area area_vector(Vec3 a, Vec3 b, Vec3 c) {
  const double ux = double(b.x) - a.x, uy = double(b.y) - a.y, uz = double(b.z) - a.z;
  const double vx = double(c.x) - a.x, vy = double(c.y) - a.y, vz = double(c.z) - a.z;
  return {(uy * vz - uz * vy) / 2, (uz * vx - ux * vz) / 2, (ux * vy - uy * vx) / 2};
}

double size(Area a) { return std::sqrt(a.nx * a.nx + a.ny * a.ny + a.nz * a.nz); }

/// Checks that the triangles have the polygon's winding and together exactly its area: then they
/// neither overlap nor leave the polygon. Returns the smallest triangle's area.
double expect_covered(const std::vector<Vec3>& polygon) {
  const auto triangles = triangulate(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  Area whole;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Area a = area_vector(polygon[0], polygon[i - 1], polygon[i]);
    whole.nx += a.nx, whole.ny += a.ny, whole.nz += a.nz;
  }
  double sum = 0, smallest = INFINITY;
  for (const auto& t : triangles) {
    const Area a = area_vector(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    EXPECT_GE(a.nx * whole.nx + a.ny * whole.ny + a.nz * whole.nz, 0);
    sum += size(a);
    smallest = std::min(smallest, size(a));
  }
  // Corners off the plane by the rounding of float, relative to the place, not the size.
  double reach = 0;
  for (const Vec3 p : polygon) reach = std::max<double>(reach, max_component(abs(p)));
  const double extent = std::sqrt(size(whole));
  const double n = static_cast<double>(polygon.size());
  EXPECT_NEAR(sum, size(whole), n * 0x1p-23 * reach * std::max(extent, reach));
  return smallest;
}

TEST(Polygon, ConvexBecomesTheFanOfMitsuba) {
  const std::vector<Vec3> quad{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto t = triangulate(quad);
  ASSERT_EQ(t.size(), 2u);
  EXPECT_EQ(t[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(t[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

TEST(Polygon, ConcaveQuadIsSplitAtItsNotch) {
  // An arrow head: only the diagonal through the notch (corner 3) lies inside.
  const std::vector<Vec3> arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
  EXPECT_GT(expect_covered(arrow), 0.4);
  for (std::size_t shift = 1; shift < 4; ++shift) {
    std::vector<Vec3> turned;
    for (std::size_t i = 0; i < 4; ++i) turned.push_back(arrow[(i + shift) % 4]);
    EXPECT_GT(expect_covered(turned), 0.4);
  }
}

TEST(Polygon, EveryAxisAndBothWindings) {
  const std::vector<Vec2> letter_l{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vec3> polygon;
    for (const Vec2 q : letter_l) {
      const float c[3] = {q.x, q.y, 0.25f};
      polygon.push_back({c[(3 - axis) % 3], c[(4 - axis) % 3], c[(5 - axis) % 3]});
    }
    expect_covered(polygon);
    expect_covered({polygon.rbegin(), polygon.rend()});
  }
}

TEST(Polygon, StarsOfAnySizeAnywhere) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    Rng rng(1, Stream::test, 0, i);
    const int corners = 5 + static_cast<int>(rng.uniform() * 400);
    const float scale = std::pow(10.0f, -3 + 6 * rng.uniform());
    const float turn = rng.uniform(), far = i % 2 == 0 ? 0.0f : 20.0f * scale;
    std::vector<Vec3> star;
    for (int k = 0; k < corners; ++k) {
      const float r = scale * (0.1f + 0.9f * rng.uniform());
      const float phi = 2 * kPi * static_cast<float>(k) / static_cast<float>(corners);
      star.push_back({r * std::cos(phi) + far, r * std::sin(phi), turn * r * std::cos(phi)});
    }
    expect_covered(star);
  }
}

TEST(Polygon, StraightCornersKeepATriangleOfTheirOwn) {
  // The midpoints of the edges are corners of neighbours too: each must be a corner of a triangle
  // with area, or a ray could slip through.
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                 {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  EXPECT_GT(expect_covered(square), 0.4);
}

TEST(Polygon, DegenerateOnesEnd) {
  EXPECT_EQ(triangulate(std::vector<Vec3>(5, {1, 1, 1})).size(), 3u);
  const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_EQ(triangulate(line).size(), 2u);
  const std::vector<Vec3> bow_tie{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(bow_tie).size(), 2u);
  std::vector<Vec3> pentagram;
  for (int i = 0; i < 5; ++i) {
    const float phi = 4 * kPi * static_cast<float>(i) / 5;
    pentagram.push_back({std::cos(phi), std::sin(phi), 0});
  }
  EXPECT_EQ(triangulate(pentagram).size(), 3u);
}

}  // namespace
}  // namespace octolux
