// Where photons from infinitely far away start: the stated density is theirs, with a focus and
// without, and most of them pass the focus, however large the scene.
#include "core/scene_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/rng.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

/// Distance [m] from x to the line of a ray.
double distance(Vec3 x, const Ray& ray) {
  return static_cast<double>(length(cross(x - ray.origin, ray.direction)));
}

const SceneSphere kSpheres[] = {
    {{1, 2, -3}, 5, {1, 2, -3}, 0},
    {{1, 2, -3}, 5, {1, 2, -3}, 0.1f},
    {{1, 2, -3}, 5, {3, 1, -2}, 0.4f},      // off the centre
    {{0, 0, 0}, 4, {0, 3.999f, 0}, 0.02f},  // on the rim
};

/// The mean of 1 / density over the photons that pass a disk is its area: all, and a part of it;
/// near the focus, and far from it.
TEST(SceneSphere, DensityIsThatOfItsRays) {
  constexpr int kRays = 200'000;
  const double alpha = sidak(kAlpha, 4 * 4);
  int test = 0;
  for (const SceneSphere& sphere : kSpheres) {
    const Vec3 wi = normalize(Vec3{0.3f, 0.8f, -0.4f});
    const Frame frame = Frame::from_normal(wi);
    const auto radius = static_cast<double>(sphere.radius);
    // Disks at right angles to wi: {centre, radius}, all within the shadow of the sphere.
    const Vec3 half_way = (sphere.focus + sphere.center) * 0.5f;
    const std::pair<Vec3, double> disks[] = {
        {sphere.center, radius},
        {half_way + frame.s * (0.2f * sphere.radius), 0.25 * radius},
        {sphere.center - frame.s * (0.6f * sphere.radius), 0.3 * radius},
        {half_way, 0.02 * radius}};
    for (const auto& [center, size] : disks) {
      Running area;
      Rng rng(1, Stream::test, 77, static_cast<std::uint64_t>(test++));
      for (int i = 0; i < kRays; ++i) {
        const SceneSphere::Start start = sphere.incoming(wi, rng.uniform2());
        ASSERT_GT(start.pdf_a, 0);
        ASSERT_LE(distance(sphere.center, start.ray), radius * 1.00001);
        ASSERT_GE(dot(sphere.center - start.ray.origin, start.ray.direction), sphere.radius);
        area.add(distance(center, start.ray) < size ? 1 / static_cast<double>(start.pdf_a) : 0);
      }
      const double truth = std::numbers::pi * size * size;
      if (area.variance() < 1e-6 * truth * truth) {  // without a focus all weigh the same
        EXPECT_NEAR(area.mean(), truth, 1e-5 * truth);
      } else {
        EXPECT_GT(z_test_p(area.z(truth)), alpha) << test << ": " << area.mean() << " " << truth;
      }
    }
  }
}

/// As many photons pass at 1 to 10 as at 10 to 100 times `near`, and none is rarer than by half of
/// what is spread evenly (a quarter of that where the focus lies on the rim).
TEST(SceneSphere, SeesTheFocusFromAnyDistance) {
  for (const float radius : {30.0f, 1e3f, 1e5f}) {
    const SceneSphere sphere{{0, 0, 0}, radius, {0.5f * radius, 0, 0}, 1};
    Rng rng(1, Stream::test, 78, 0);
    constexpr int kRays = 20'000;
    int near = 0, nearer = 0;
    for (int i = 0; i < kRays; ++i) {
      const SceneSphere::Start start = sphere.incoming({0, 0, 1}, rng.uniform2());
      const double d = distance(sphere.focus, start.ray);
      near += d < 10;
      nearer += d < 1;
      EXPECT_GT(start.pdf_a * sphere.cross_section(), 0.5f / 2.25f * 0.999f);
    }
    // ln(101) or ln(2) of the log range's 2 ln(R), half of all photons.
    const double range = 2 * std::log(static_cast<double>(radius) * 1.5);
    EXPECT_GT(near, 0.5 * kRays * std::log(101) / range * 0.9) << radius;
    EXPECT_GT(nearer, 0.5 * kRays * std::log(2) / range * 0.8) << radius;
  }
}

/// Odd sizes: far beyond a float's digits, and the middle and corners of the square.
TEST(SceneSphere, OddSizesAreHarmless) {
  for (const float near : {1e-12f, 1e-3f, 10.0f, 1e6f}) {
    const SceneSphere sphere{{0, 0, 0}, 10, {3, 4, 0}, near};
    for (const Vec2 u : {Vec2{0.5f, 0.5f}, Vec2{0, 0}, Vec2{0, kOneMinusEpsilon},
                         Vec2{kOneMinusEpsilon, kOneMinusEpsilon}, Vec2{0.5f, 0.50001f}}) {
      const SceneSphere::Start start = sphere.incoming({0, 0, -1}, u);
      EXPECT_TRUE(std::isfinite(start.pdf_a) && start.pdf_a > 0) << near;
      EXPECT_TRUE(is_finite(start.ray.origin)) << near;
      EXPECT_LE(distance({0, 0, 0}, start.ray), 10.0001) << near;
    }
  }
}

}  // namespace
}  // namespace octolux
