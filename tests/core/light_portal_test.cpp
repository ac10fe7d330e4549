// Portals: photons pass them, their flux is what it was without, and none is much brighter.
#include "core/light_portal.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/rng.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

constexpr Vec3 kCenter{1, 2, 3};
constexpr float kRadius = 10;
const Vec3 kDown = normalize(Vec3{0.3f, -1, 0.2f});

/// A skylight of 1 x 1 m in the plane y = 4, in two triangles, and a smaller one beside it.
std::vector<TriangleMesh> skylights() {
  TriangleMesh a, b;
  a.positions = {{0, 4, 2}, {1, 4, 2}, {1, 4, 3}, {0, 4, 3}};
  a.triangles = {{0, 1, 2}, {0, 2, 3}};
  b.positions = {{3, 4, 2}, {3, 4, 3}, {3, 3, 3}};
  b.triangles = {{0, 1, 2}};
  return {a, b};
}

bool in_skylight(const Ray& ray) {
  const float t = (4 - ray.origin.y) / ray.direction.y;
  const Vec3 p = ray.origin + ray.direction * t;
  return t > 0 && p.x > 0 && p.x < 1 && p.z > 2 && p.z < 3;
}

using MakeLight = std::function<std::unique_ptr<Light>()>;

std::vector<MakeLight> infinite_lights() {
  const auto envmap = [] {
    Image image{8, 5};
    for (int i = 0; i < 40; ++i) image.pixels[i] = Rgb(static_cast<float>(i % 7), 1, 2);
    return make_envmap_light(std::move(image), {}, 1);
  };
  return {[] {
            return make_directional_light(kDown, {3, 2, 1});
          },
          [] {
            return make_constant_light({1, 2, 3});
          },
          envmap};
}

TEST(Portals, DensityOfLines) {
  const Portals portals(skylights());
  EXPECT_DOUBLE_EQ(portals.area(), 1.5);
  EXPECT_NEAR(portals.line_density({0.4f, 9, 2.7f}, {0, -1, 0}), 1 / 1.5, 1e-6);
  EXPECT_NEAR(portals.line_density({0.4f, 0, 2.7f}, {0, -1, 0}), 1 / 1.5, 1e-6);  // a line, no ray
  EXPECT_EQ(portals.line_density({1.4f, 9, 2.7f}, {0, -1, 0}), 0);
  const float s = std::sqrt(0.5f);
  EXPECT_NEAR(portals.line_density({0.4f, 4, 2.7f}, {s, -s, 0}), std::sqrt(2.0) / 1.5, 1e-6);
  // Through both: x runs from 0.5 to 3 while y falls from 4 to 3.8.
  const Vec3 flat = normalize(Vec3{2.5f, -0.2f, 0});
  const double both = 1 / std::abs(flat.y) + 1 / std::abs(flat.x);
  EXPECT_NEAR(portals.line_density({0.5f, 4, 2.9f}, flat), both / 1.5, 1e-5 * both);
}

TEST(Portals, FluxIsThatOfTheLight) {
  const Portals portals(skylights());
  for (const MakeLight& make : infinite_lights()) {
    auto plain = make();
    plain->set_scene_bounds(kCenter, kRadius);
    const auto aimed = aim_at_portals(make(), portals);
    aimed->set_scene_bounds(kCenter, kRadius);
    EXPECT_EQ(aimed->power().r, plain->power().r);
    Rng rng(1, Stream::test, 310, 0);
    Running total, through, through_plain;
    int passing = 0;
    constexpr int kDraws = 200'000;
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 u_position = rng.uniform2();
      const Vec2 u_direction = rng.uniform2();
      const EmittedPhoton a = aimed->emit(u_position, u_direction);
      const EmittedPhoton p = plain->emit(u_position, u_direction);
      const auto flux = static_cast<double>(mean(a.flux));
      ASSERT_LE(mean(a.flux), mean(p.flux) * (1 + 1e-5f) / (1 - kPortalShare));
      passing += in_skylight(a.ray);
      total.add(flux);
      through.add(in_skylight(a.ray) ? flux : 0);
      through_plain.add(in_skylight(p.ray) ? static_cast<double>(mean(p.flux)) : 0);
    }
    const double limit = kAlpha / 6;
    EXPECT_GT(z_test_p(total.z(static_cast<double>(mean(plain->power())))), limit);
    const double error = std::hypot(through.standard_error(), through_plain.standard_error());
    EXPECT_GT(z_test_p((through.mean() - through_plain.mean()) / error), limit)
        << through.mean() << " " << through_plain.mean();
    EXPECT_GT(passing, 0.2 * kDraws);  // half of the photons, a third of them to the other portal
    EXPECT_LT(through.standard_error(), 0.2 * through_plain.standard_error());
  }
}

TEST(Portals, TheSunThroughASkylightHasAClosedForm) {
  const Portals portals(skylights());
  const auto sun = aim_at_portals(make_directional_light(kDown, Rgb(5)), portals);
  sun->set_scene_bounds(kCenter, kRadius);
  Rng rng(1, Stream::test, 311, 0);
  Running through;
  for (int i = 0; i < 100'000; ++i) {
    const Vec2 u_position = rng.uniform2();
    const EmittedPhoton photon = sun->emit(u_position, {0.5f, 0.5f});
    through.add(in_skylight(photon.ray) ? static_cast<double>(photon.flux.g) : 0);
  }
  EXPECT_GT(z_test_p(through.z(5 * std::abs(static_cast<double>(kDown.y)))), kAlpha)
      << through.mean();
}

TEST(Portals, WhatIsAimedAtThemHasNoExtent) {
  for (const MakeLight& make : infinite_lights()) EXPECT_FALSE(make()->extent());
  EXPECT_TRUE(make_point_light({0, 0, 0}, Rgb(1))->extent());
}

}  // namespace
}  // namespace octolux
