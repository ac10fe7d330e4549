// A mesh in parts: shares and extents add up to the mesh, samples are as their densities say, and
// the parts together bring the light of the whole.
#include "core/light_parts.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/core/light_cases.h"
#include "tests/core/light_meshes.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

/// A ball of triangles of uneven sizes, and one without area.
struct Ball {
  explicit Ball(int most)
      : shape(ball_mesh({0.2f, 0, 0.1f}, 1, 8)),
        light(make_area_light(shape, Rgb(1, 2, 3))),
        parts(mesh(), *light, most) {}
  const TriangleMesh& mesh() const { return std::get<TriangleMesh>(shape.geometry); }

  Shape shape;
  std::unique_ptr<AreaLight> light;
  MeshParts parts;
};

double twice_area(const TriangleMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(triangle)];
  const auto& p = mesh.positions;
  return static_cast<double>(length(cross(p[b] - p[a], p[c] - p[a])));
}

TEST(MeshParts, SharesAndExtentsAreTheMesh) {
  for (const int most : {1, 7, 64, 1000}) {
    const Ball ball(most);
    const int triangles = static_cast<int>(ball.mesh().triangles.size());
    ASSERT_EQ(ball.parts.size(), std::min(most, triangles));
    double sum = 0;
    for (int part = 0; part < ball.parts.size(); ++part) sum += ball.parts.share(part);
    EXPECT_NEAR(sum, 1, triangles * 0x1p-52);
    std::map<int, int> members;
    for (int t = 0; t < triangles; ++t) {
      const int part = ball.parts.part_of(static_cast<std::uint32_t>(t));
      ++members[part];
      if (twice_area(ball.mesh(), t) == 0) continue;
      const LightExtent extent = ball.parts.extent(part);
      for (const std::uint32_t vertex : ball.mesh().triangles[t]) {
        Bounds grown = extent.bounds;
        grown.add(ball.mesh().positions[vertex]);
        EXPECT_TRUE(grown.lower == extent.bounds.lower && grown.upper == extent.bounds.upper);
      }
      const SurfacePoint y = surface_point(ball.mesh(), static_cast<std::uint32_t>(t), 0, 0);
      EXPECT_GE(dot(y.ng, extent.axis), std::cos(extent.normals) - 0x1p-20f);
    }
    for (const auto& [part, count] : members) {
      EXPECT_LE(std::abs(count - triangles / ball.parts.size()), 1) << part;
    }
  }
}

/// Points of a part are uniform by area: counts per triangle.
TEST(MeshParts, PointsAreUniformByArea) {
  const Ball ball(5);
  const auto triangles = ball.mesh().triangles.size();
  for (int part = 0; part < 5; ++part) {
    std::vector<double> areas(triangles, 0.0), counts(triangles, 0.0);
    const Vec3 x = Vec3{0.2f, 0, 0.1f} + ball.parts.extent(part).axis * 40;
    Rng rng(1, Stream::test, 760, static_cast<std::uint64_t>(part));
    constexpr int kDraws = 40000;
    int seen = 0;
    for (int i = 0; i < kDraws; ++i) {
      const auto s = ball.parts.sample(part, x, rng.uniform2());
      if (!s) continue;  // it faces away
      ++seen;
      ++counts[s->at.primitive];
      EXPECT_EQ(ball.parts.part_of(s->at.primitive), part);
      EXPECT_FLOAT_EQ(s->pdf_w, ball.parts.pdf_w(x, s->at));
    }
    double all = 0;
    for (std::size_t t = 0; t < triangles; ++t) {
      const auto index = static_cast<std::uint32_t>(t);
      if (ball.parts.part_of(index) != part || counts[t] == 0) continue;
      all += areas[t] = twice_area(ball.mesh(), static_cast<int>(t));
    }
    for (double& a : areas) a *= seen / all;
    EXPECT_GT(chi2_test_p(counts, areas), sidak(kAlpha, 5)) << part;
  }
}

TEST(MeshParts, TogetherTheyAreTheLight) {
  const Ball ball(20);
  Rng rng(1, Stream::test, 761, 0);
  const auto value = [](const std::optional<LightSample>& s) {
    return s ? static_cast<double>(s->radiance.g / s->pdf_w * std::abs(s->wi.z)) : 0;
  };
  for (const Vec3 x : {Vec3{0, 0, 3}, Vec3{1.3f, 0.4f, -0.6f}}) {
    Running difference;
    for (int i = 0; i < 30000; ++i) {
      const float u = rng.uniform();
      const int part = std::min(19, static_cast<int>(u * 20));
      const double by_part = 20 * value(ball.parts.sample(part, x, rng.uniform2()));
      difference.add(by_part - value(ball.light->sample(x, rng.uniform2())));
    }
    EXPECT_GT(z_test_p(difference.z(0)), sidak(kAlpha, 2));
  }
}

}  // namespace
}  // namespace octolux
