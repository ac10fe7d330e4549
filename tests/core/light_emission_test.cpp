// Photons leaving lights: flux sums to the power, positions and directions are as the radiance
// says, and what they carry through a window is what next-event estimation finds arriving there.
#include <gtest/gtest.h>

#include "tests/core/light_window.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

TEST(Emission, MeanFluxIsThePower) {
  constexpr int kPhotons = 40000;
  const auto lights = lit_shapes();
  int test = 0;
  for (const auto& lit : lights) {
    Running flux;
    Rng rng(1, Stream::test, 70, test++);
    for (int i = 0; i < kPhotons; ++i) {
      const Vec2 u = rng.uniform2();
      const EmittedPhoton photon = lit->light->emit(u, rng.uniform2());
      flux.add(photon.flux.r);
      EXPECT_FLOAT_EQ(photon.flux.g, 2 * photon.flux.r);
      EXPECT_FLOAT_EQ(photon.flux.b, 3 * photon.flux.r);
    }
    // Photons of the same flux leave only rounding, and the quadrature of the area (below 1e-4).
    const double power = lit->light->power().r;
    EXPECT_NEAR(flux.mean(), power, 1e-4 * power + 5 * flux.standard_error()) << lit->name;
    EXPECT_FLOAT_EQ(lit->light->power().b, static_cast<float>(3 * area(lit->shape()) * kPi));
  }
}

TEST(Emission, PowersInClosedForm) {
  const LitShape flat("", rectangle(1, 0.5f), {});
  EXPECT_FLOAT_EQ(flat.light->power().r, 2 * kPi);
  EXPECT_FLOAT_EQ(flat.light->emit({0.1f, 0.7f}, {0.3f, 0.9f}).flux.b, 6 * kPi);
  const Affine triple = affine({3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3, 0});
  const auto power = [&](Quadric::Kind kind) {
    return LitShape("", quadric(kind, triple), {}).light->power().r;
  };
  EXPECT_FLOAT_EQ(power(Quadric::Kind::sphere), 4 * 9 * kPi * kPi);
  EXPECT_FLOAT_EQ(power(Quadric::Kind::disk), 9 * kPi * kPi);
  EXPECT_FLOAT_EQ(power(Quadric::Kind::cylinder), 2 * 9 * kPi * kPi);
  EXPECT_FLOAT_EQ(make_point_light({1, 2, 3}, {1, 2, 5})->power().b, 20 * kPi);
  const auto sky = make_constant_light({1, 2, 3});
  sky->set_scene_bounds({1, 1, 1}, 2);
  EXPECT_FLOAT_EQ(sky->power().g, 2 * 4 * kPi * 4 * kPi);
}

/// A picture of one colour lights a screen evenly, pi times as brightly, and nothing beside it.
TEST(Emission, ProjectorLightsAScreenEvenly) {
  const Affine aim = *look_at({0, 0, 0}, {0, 0, 4}, {0, 1, 0});
  const auto light = make_projector_light({.to_world = aim, .picture = Rgb(2), .aspect = 2});
  EXPECT_FLOAT_EQ(light->power().r, 2 * kPi * 0.5f);
  for (const Vec2 p : {Vec2{0, 0}, Vec2{1.99f, 0}, Vec2{-1.5f, 0.9f}, Vec2{1, -0.99f}}) {
    const auto s = light->sample({p.x, p.y, 4}, {});
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->radiance.r * -s->wi.z, 2 * kPi / 16, 16 * 0x1p-23f);
  }
  EXPECT_FALSE(light->sample({2.01f, 0, 4}, {}));
  EXPECT_FALSE(light->sample({0, 1.01f, 4}, {}));
  EXPECT_FALSE(light->sample({0, 0, -4}, {}));
}

TEST(Emission, ProjectorPhotonsCarryWhatIsSeenOfTheScreen) {
  const std::unique_ptr<Texture> slide =
      make_checkerboard_texture({1, 2, 3}, {3, 5, 1}, scaling(3, 2, 1));
  const Affine aim = *look_at({0, 0, 0}, {0, 0, 4}, {0, 1, 0});
  const auto light = make_projector_light({.to_world = aim, .picture = Color(*slide), .aspect = 2});
  constexpr float kArea = 1.0f / 2;  // of the screen, at distance 1
  for (int i = 0; i < 49; ++i) {
    const Vec2 u{(static_cast<float>(i % 7) + 0.5f) / 7, (static_cast<float>(i / 7) + 0.5f) / 7};
    const EmittedPhoton photon = light->emit({}, u);
    const auto seen = light->sample(photon.ray.origin + photon.ray.direction * 2, {});
    ASSERT_TRUE(seen);
    const float cosine = photon.ray.direction.z;
    const Rgb flux = seen->radiance * (4 * cosine * cosine * cosine * kArea);
    EXPECT_NEAR(flux.r, photon.flux.r, 16 * 0x1p-24f * flux.r) << u.x << " " << u.y;
    EXPECT_NEAR(flux.b, photon.flux.b, 16 * 0x1p-24f * flux.b) << u.x << " " << u.y;
  }
}

TEST(Emission, RectanglePhotonsAreUniformAndCosineDistributed) {
  constexpr int kPhotons = 200000, kGrid = 12;
  const LitShape lit("", rectangle(1, 0.5f), {});
  std::vector<double> places(kGrid * kGrid, 0.0), ways(kGrid * kGrid, 0.0);
  Rng rng(1, Stream::test, 71, 0);
  const auto bin = [](float v) { return std::clamp(static_cast<int>(v * kGrid), 0, kGrid - 1); };
  for (int i = 0; i < kPhotons; ++i) {
    const Vec2 u = rng.uniform2();
    const Ray ray = lit.light->emit(u, rng.uniform2()).ray;
    ++places[bin(ray.origin.y + 0.5f) * kGrid + bin((ray.origin.x + 1) / 2)];
    const Vec3 w = ray.direction;
    ++ways[bin(w.z * w.z) * kGrid + bin(std::atan2(w.y, w.x) / (2 * kPi) + 0.5f)];
  }
  const std::vector<double> expected(kGrid * kGrid, double(kPhotons) / (kGrid * kGrid));
  EXPECT_GT(chi2_test_p(places, expected), sidak(kAlpha, 2));
  EXPECT_GT(chi2_test_p(ways, expected), sidak(kAlpha, 2));
}

TEST(Emission, RaysStartOffTheFrontOfTheSurface) {
  for (const auto& lit : lit_shapes()) {
    Rng rng(1, Stream::test, 72, 0);
    const bool closed = lit->name.find("inside") == std::string::npos;
    for (int i = 0; i < 5000; ++i) {
      const Vec2 u = rng.uniform2();
      const Ray ray = lit->light->emit(u, rng.uniform2()).ray;
      ASSERT_NEAR(length(ray.direction), 1, 4 * 0x1p-24f);
      EXPECT_EQ(ray.t_min, 0);
      // A convex shape that shines outwards is never met again.
      if (closed) {
        EXPECT_FALSE(lit->hit(ray)) << lit->name;
      }
    }
  }
}

TEST(Emission, PhotonsThroughAWindowAgreeWithNextEventEstimation) {
  const double alpha = sidak(kAlpha, 15);
  int test = 0;
  for (const auto& lit : lit_shapes()) {
    const Vec3 n = normalize(normalize(lit->toward - lit->x) + Vec3{0.3f, 0.2f, -0.1f});
    const Window window{lit->x, Frame::from_normal(n), 0.05f};
    EXPECT_GT(same_flux_p(*lit->light, window, test++), alpha) << lit->name;
  }
  const Window window{{0.5f, -0.3f, 0.2f}, Frame::from_normal(normalize({1, 2, -0.5f})), 0.4f};
  const std::unique_ptr<Light> point = make_point_light({2, 1, -1}, {1, 2, 3});
  EXPECT_GT(same_flux_p(*point, window, test++), alpha);
  const std::unique_ptr<Texture> slide =
      make_checkerboard_texture({1, 2, 3}, {3, 5, 1}, scaling(3, 2, 1));
  const Affine aim = *look_at({2, 1, -1}, {0.6f, -0.2f, 0.1f}, {0, 1, 0});
  const std::unique_ptr<Light> beam = make_projector_light(
      {.to_world = aim, .picture = Color(*slide), .width = 0.4f, .aspect = 1.5f});
  EXPECT_GT(same_flux_p(*beam, window, test++), alpha);
  const std::unique_ptr<EnvironmentLight> sky = make_constant_light({1, 2, 3});
  sky->set_scene_bounds({0.4f, 0, 0}, 1);
  EXPECT_GT(same_flux_p(*sky, window, test++), alpha);
  Image image(8, 5);
  for (int i = 0; i < 40; ++i) image.pixels[i] = Rgb(static_cast<float>((i * 7) % 11));
  const std::unique_ptr<EnvironmentLight> map = make_envmap_light(image, Affine{}, 2);
  map->set_scene_bounds({0.4f, 0, 0}, 1);
  EXPECT_GT(same_flux_p(*map, window, test++), alpha);
  // Also where photons seek a focus, not that of the window.
  const std::unique_ptr<Light> sun = make_directional_light(normalize({-1, -2, 0.2f}), {1, 2, 3});
  sun->set_scene_bounds({0.4f, 0, 0}, 1);
  for (Light* light : {static_cast<Light*>(sky.get()), static_cast<Light*>(map.get()), sun.get()}) {
    light->set_focus({0.2f, -0.4f, 0.3f}, 0.05f);
    EXPECT_GT(same_flux_p(*light, window, test++), alpha);
  }
}

TEST(Emission, InfiniteLightsCoverTheBoundingSphereFromBehind) {
  const std::unique_ptr<EnvironmentLight> sky = make_constant_light(Rgb(1));
  const Vec3 center{100, -20, 3};
  sky->set_scene_bounds(center, 5);
  Rng rng(1, Stream::test, 74, 0);
  for (int i = 0; i < 10000; ++i) {
    const Vec2 u = rng.uniform2();
    const Ray ray = sky->emit(u, rng.uniform2()).ray;
    const Vec3 to_center = center - ray.origin;
    EXPECT_GE(dot(to_center, ray.direction), 5);  // all of the sphere lies ahead
    EXPECT_LE(length(cross(to_center, ray.direction)), 5 + position_error_bound(ray.origin));
  }
}

TEST(Emission, InfiniteLightOfAnEmptySceneHasNoPower) {
  const std::unique_ptr<EnvironmentLight> sky = make_constant_light(Rgb(1));
  sky->set_scene_bounds({0, 0, 0}, 0);
  EXPECT_EQ(sky->power(), Rgb(0));
  EXPECT_EQ(sky->emit({0.1f, 0.2f}, {0.3f, 0.4f}).flux, Rgb(0));
}

}  // namespace
}  // namespace octolux
