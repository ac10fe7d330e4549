// Building the ray caster of so much that Embree's threads share the work: all is found afterwards,
// and what they call back may be seen from any of them (which is for ThreadSanitizer to judge).
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "accel/ray_caster.h"
#include "core/parallel.h"
#include "core/rng.h"

namespace octolux {
namespace {

constexpr std::uint32_t kShapes = 20'000;
constexpr std::uint32_t kTriangles = 50'000;
constexpr float kRounding = 8 * 0x1p-24f;  // of t, a difference, product and quotient of sums

Vec3 place_of(std::uint32_t number) {
  Rng rng(20260101, Stream::test, 5, number);
  const float x = rng.uniform();
  const float y = rng.uniform();
  const float z = rng.uniform();
  return {x, y, z};
}

std::vector<Shape> spheres() {
  std::vector<Shape> shapes;
  for (std::uint32_t i = 0; i < kShapes; ++i) {
    const Vec3 at = place_of(i);
    Quadric sphere;
    sphere.to_world = translation(at.x, at.y, at.z) * scaling(1e-3, 1e-3, 1e-3);
    sphere.to_object = *sphere.to_world.inverse();
    shapes.push_back({sphere, -1, -1, ""});
  }
  return shapes;
}

/// All facing +z, each around its place.
std::vector<Shape> triangles() {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    const Vec3 at = place_of(i);
    mesh.positions.push_back(at + Vec3{-1e-3f, -1e-3f, 0});
    mesh.positions.push_back(at + Vec3{2e-3f, -1e-3f, 0});
    mesh.positions.push_back(at + Vec3{-1e-3f, 2e-3f, 0});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {{std::move(mesh), -1, -1, ""}};
}

/// Builds, and looks from above at the place of each of `count` objects: one is there, or before
/// it.
void build_and_look(const std::vector<Shape>& shapes, std::uint32_t count) {
  const ThreadLimit limit(4);
  std::atomic<int> reports = 0, wrong = 0;
  const RayCaster caster(shapes, {}, [&](double share) {
    ++reports;
    if (!(share >= 0 && share <= 1)) ++wrong;
  });
  EXPECT_GT(reports, 1);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(caster.memory(), 0);
  parallel_for_chunks(count, 1000, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const Vec3 at = place_of(static_cast<std::uint32_t>(i));
      const auto hit = caster.closest({{at.x, at.y, 2}, {0, 0, -1}});
      if (!hit || !(hit->t <= (2 - at.z) * (1 + kRounding))) ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
}

TEST(RayCasterBuild, FindsAllOfManyQuadrics) { build_and_look(spheres(), kShapes); }

TEST(RayCasterBuild, FindsAllOfManyTriangles) { build_and_look(triangles(), kTriangles); }

}  // namespace
}  // namespace octolux
