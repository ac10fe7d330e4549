// What `octolux ab` measures and where: leaks against sums made by hand, masks against the geometry
// of a floor with a wall on it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "tests/renderer/renders.h"
#include "tests/tools/pictures.h"
#include "tools/ab/leaks.h"
#include "tools/ab/masks.h"
#include "tools/ab/plan.h"

namespace octolux {
namespace {

using test::constant;
using test::paint;

TEST(Leaks, AreInUnitsOfTheWholeReference) {
  // Left half: y 1, x 1.5. Right half: y 0, x 0.25. Mean y 0.5.
  const NamedPicture y =
      test::picture("y", paint(8, 4, [](int x, int) { return Rgb(x < 4 ? 1.f : 0.f); }));
  const NamedPicture x =
      test::picture("x", paint(8, 4, [](int i, int) { return Rgb(i < 4 ? 0.5f : 0.25f); }));
  Mask right(32, 0);
  for (std::size_t i = 0; i < right.size(); ++i) right[i] = i % 8 >= 4;
  const LeakFigures all = measure_leaks(view_layer(y), view_layer(x), {});
  EXPECT_EQ(all.pixels, 32);
  EXPECT_EQ(all.light, 0.25);  // 0.25 over half the image, by 0.5
  EXPECT_EQ(all.shadow, 0.5);
  EXPECT_FALSE(all.noise);
  const LeakFigures sealed = measure_leaks(view_layer(y), view_layer(x), right);
  EXPECT_EQ(sealed.pixels, 16);
  EXPECT_EQ(sealed.light, 0.5);
  EXPECT_EQ(sealed.shadow, 0);
  const ScalarField field = leak_field(view_layer(y), view_layer(x));
  EXPECT_EQ(field.values[0], -1);
  EXPECT_EQ(field.values[7], 0.5f);
}

/// Without bias both leaks read the noise that is announced.
TEST(Leaks, NoiseIsWhatBothReadWithoutBias) {
  constexpr int kSide = 200;
  constexpr float kDeviation = 0.1f;
  Rng rng(5, Stream::test, 0, 0);
  const Image noisy = paint(kSide, kSide, [&](int, int) {
    const float u = rng.uniform();
    const float v = rng.uniform();
    const float g = std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * kPi * v);  // Box & Muller
    return Rgb(1 + kDeviation * g);
  });
  const Image variance = constant(kSide, kSide, Rgb(kDeviation * kDeviation));
  const NamedPicture y = test::picture("y", constant(kSide, kSide, Rgb(1)));
  const NamedPicture x = test::noisy_picture("x", noisy, variance, 100);
  const LeakFigures leaks = measure_leaks(view_layer(y), view_layer(x), {});
  ASSERT_TRUE(leaks.noise);
  // Of max(0, g): mean 1/sqrt(2 pi), variance 1/2 - 1/(2 pi).
  const double se = kDeviation * std::sqrt((0.5 - 0.5 / std::numbers::pi)) / kSide;
  EXPECT_GT(z_test_p((leaks.light - *leaks.noise) / se), 1e-4);
  EXPECT_GT(z_test_p((leaks.shadow - *leaks.noise) / se), 1e-4);
  EXPECT_NEAR(*leaks.noise, kDeviation / std::sqrt(2 * std::numbers::pi), 1e-8);
}

TEST(Leaks, PixelsThatAreNotFiniteAreLeftOut) {
  Image broken = constant(4, 4, Rgb(2));
  broken.at(1, 1).g = std::numeric_limits<float>::quiet_NaN();
  const NamedPicture y = test::picture("y", constant(4, 4, Rgb(1)));
  const NamedPicture x = test::picture("x", broken), black = test::picture("b", Image(4, 4));
  const LeakFigures leaks = measure_leaks(view_layer(y), view_layer(x), {});
  EXPECT_EQ(leaks.pixels, 15);
  EXPECT_EQ(leaks.light, 1);
  EXPECT_TRUE(std::isnan(leak_field(view_layer(y), view_layer(x)).values[5]));
  EXPECT_TRUE(std::isnan(measure_leaks(view_layer(black), view_layer(y), {}).light));
}

TEST(Plan, NamesKernelsAndGatherings) {
  RenderConfig base;
  base.estimator.neighbours = 33;
  const auto renders = plan_renders(base, {"cone", "octobox:published"}, {"off", "on"});
  ASSERT_EQ(renders.size(), 4u);
  EXPECT_EQ(renders[1].name, "octobox:published, gather off");
  EXPECT_EQ(renders[1].stem, "octobox-published-gather-off");
  EXPECT_FALSE(renders[1].config.estimator.correction);
  EXPECT_EQ(renders[1].config.estimator.neighbours, 33);
  EXPECT_FALSE(renders[1].config.eye.gather);
  EXPECT_TRUE(renders[2].config.eye.gather);
  EXPECT_TRUE(renders[2].config.estimator.correction);
  EXPECT_EQ(plan_renders(base, {"cone"}, {"on"})[0].name, "cone");
  EXPECT_THROW(plan_renders(base, {"cone", "cone"}, {"on"}), Error);
  EXPECT_THROW(plan_renders(base, {"coin"}, {"on"}), Error);
  EXPECT_THROW(plan_renders(base, {"cone"}, {"maybe"}), Error);
}

constexpr int kWidth = 60, kHeight = 40;
constexpr float kHalf = 3, kWall = 0.05f;  // [m] half the floor's side, half the wall's thickness

/// A square floor seen from above, a thin wall across it at x = 0, a lamp over its left half.
std::unique_ptr<Scene> floor_with_wall() {
  const auto cube = [](const std::string& scale, const std::string& move) {
    return "<shape type='cube'><transform name='to_world'><scale " + scale + "/><translate " +
           move + "/></transform></shape>";
  };
  return test::scene_from(
      "<scene version='3.0.0'>" + test::sensor_xml("0, 8, 0.01", "0, 0, 0", 50, kWidth, kHeight) +
      "<shape type='rectangle'><transform name='to_world'><scale value='3'/><rotate x='1' "
      "angle='-90'/></transform></shape>" +
      cube("x='0.05' y='2' z='4'", "x='0'") +
      "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='90'/><translate "
      "x='-2' y='1'/></transform><emitter type='area'><rgb name='radiance' value='5'/>"
      "</emitter></shape></scene>");
}

/// Where the centre of a pixel looks, if that is the floor and no lamp is near.
std::optional<Vec3> on_floor(const Scene& scene, int x, int y) {
  const Ray ray = scene.camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
  const auto hit = scene.caster->closest(ray);
  if (!hit || hit->shape != 0) return std::nullopt;
  return ray.origin + ray.direction * hit->t;
}

TEST(Masks, NearIsWhereAWallOrTheEdgeIsWithinReach) {
  const auto scene = floor_with_wall();
  RenderConfig config;
  config.photons.global = 20000;
  config.estimator.neighbours = 20;
  const SeenSurfaces seen = see_surfaces(*scene, config, 1);
  int near = 0, open = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const auto p = on_floor(*scene, i % kWidth, i / kWidth);
    if (!p || seen.surface[i] == 0) continue;
    const float to_wall = std::abs(p->x) - kWall;
    const float to_edge = std::min(kHalf - std::abs(p->x), kHalf - std::abs(p->z));
    const float distance = std::min(to_wall, to_edge), reach = seen.reach[i];
    ASSERT_GT(reach, 0);
    // One of 32 feelers is within 360/64 degrees of the shortest way.
    const float farthest = distance / std::cos(kPi / 32);
    // Walls are met where a feeler's lifted ray does, edges are found to a share of its length.
    if (farthest < 1.0f * reach) {
      EXPECT_TRUE(seen.near_edge[i]) << p->x << " " << p->z;
    }
    if (distance > reach) {
      EXPECT_FALSE(seen.near_edge[i]) << p->x << " " << p->z;
    }
    ++(seen.near_edge[i] != 0 ? near : open);
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(open, 100);
}

TEST(Masks, SurfacesAreSealedNearWallsOrOpen) {
  const auto scene = floor_with_wall();
  RenderConfig config;
  config.photons.global = 20000;
  const SeenSurfaces seen = see_surfaces(*scene, config, 1);
  // Right of the wall no light arrives; one dark pixel to the left is chance.
  Image picture = paint(kWidth, kHeight, [](int x, int) { return Rgb(x < kWidth / 2 ? 1.f : 0); });
  picture.at(5, 20) = Rgb(0);
  const NamedPicture y = test::picture("y", picture);
  const std::vector<NamedMask> masks = leak_masks(seen, view_layer(y));
  ASSERT_EQ(masks.size(), 4u);
  EXPECT_EQ(masks[0].key, "image");
  EXPECT_EQ(masks[0].pixels, kWidth * kHeight);
  std::int64_t parts = 0;
  for (std::size_t m = 1; m < masks.size(); ++m) parts += masks[m].pixels;
  EXPECT_EQ(parts, count_pixels(seen.surface, seen.surface.size()));
  const Mask& sealed = masks[3].mask;
  EXPECT_EQ(masks[3].key, "sealed");
  EXPECT_FALSE(sealed[20 * kWidth + 5]);
  for (int x = kWidth / 2 + 1; x < kWidth; ++x) {
    EXPECT_EQ(sealed[20 * kWidth + x], seen.surface[20 * kWidth + x]) << x;
  }
}

TEST(Masks, LampsAndTheirRimsAreNoSurfaces) {
  const auto scene = floor_with_wall();
  const SeenSurfaces seen = see_surfaces(*scene, {}, 1);
  int lamps = 0;
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x) {
      const Ray ray =
          scene->camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
      const auto hit = scene->caster->closest(ray);
      if (!hit || hit->shape != 2) continue;
      ++lamps;
      for (const int at : {-kWidth - 1, -kWidth, -1, 0, 1, kWidth, kWidth + 1}) {
        EXPECT_FALSE(seen.surface[y * kWidth + x + at]);
      }
    }
  }
  EXPECT_GT(lamps, 20);
}

}  // namespace
}  // namespace octolux
