// The light tree: a distribution at every point, the one it says, and never 0 where light arrives.
#include "renderer/light_tree.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "renderer/light_sampler.h"
#include "renderer/scene.h"
#include "tests/core/light_cases.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

/// Shapes of all kinds and point lights, at random places, sizes, turns and powers.
void scatter_lights(Scene& scene, int count, Rng& rng) {
  scene.shapes.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double size = std::pow(10.0, -1.5 + static_cast<double>(rng.uniform()));
    const Vec3 axis = sample_sphere(rng.uniform2());
    const double degrees = 360 * static_cast<double>(rng.uniform());
    const double x = 4 * static_cast<double>(rng.uniform());
    const double y = 2 * static_cast<double>(rng.uniform());
    const double z = 4 * static_cast<double>(rng.uniform());
    const Affine map = translation(x, y, z) * rotation(axis.x, axis.y, axis.z, degrees) *
                       scaling(size, size * 0.4, size * (i % 3 ? 1 : 2));
    const Rgb radiance(std::pow(10.0f, 2 * rng.uniform()));
    if (i % 5 == 4) {
      scene.lights.push_back(make_point_light(map.point({0, 0, 0}), radiance * 0.1f));
      continue;
    }
    Shape shape = rectangle(1, 0.5f);
    if (i % 5 == 3 && i < 100) {
      shape = quadric(Quadric::Kind(rng.next() % 3), map, rng.uniform() < 0.5f);
    } else {
      for (Vec3& p : std::get<TriangleMesh>(shape.geometry).positions) p = map.point(p);
    }
    shape.light = static_cast<int>(scene.lights.size());
    scene.shapes.push_back(std::move(shape));
    scene.lights.push_back(make_area_light(scene.shapes.back(), radiance));
  }
}

std::vector<LightBounds> bounds_of(const Scene& scene) {
  std::vector<LightBounds> bounds;
  for (const auto& light : scene.lights) {
    bounds.push_back({*light->extent(), static_cast<double>(mean(light->power()))});
  }
  return bounds;
}

Receiver random_receiver(Rng& rng) {
  const float x = -1 + 6 * rng.uniform();
  const float y = -1 + 4 * rng.uniform();
  const float z = -1 + 6 * rng.uniform();
  const Vec3 normal = sample_sphere(rng.uniform2());
  return {{x, y, z}, normal, rng.uniform() < 0.25f};
}

TEST(LightTree, ProbabilitiesSumToOne) {
  for (const int count : {1, 2, 3, 12, 100, 1000}) {
    Rng rng(1, Stream::test, 700, static_cast<std::uint64_t>(count));
    Scene scene;
    scatter_lights(scene, count, rng);
    const LightTree tree(bounds_of(scene));
    for (int i = 0; i < 20; ++i) {
      const Receiver at = random_receiver(rng);
      double sum = 0;
      for (int l = 0; l < count; ++l) sum += static_cast<double>(tree.choice(at, l).pmf());
      // Each share and each product of a walk rounds once; no walk is longer than `count` or 64.
      EXPECT_NEAR(sum, 1, 2 * std::min(count, 64) * 0x1p-24) << count;
    }
  }
}

TEST(LightTree, ChoosesAsItSays) {
  Rng rng(1, Stream::test, 701, 0);
  Scene scene;
  scatter_lights(scene, 60, rng);
  const LightTree tree(bounds_of(scene));
  constexpr int kReceivers = 10, kDraws = 50000;
  for (int i = 0; i < kReceivers; ++i) {
    const Receiver at = random_receiver(rng);
    std::vector<double> counts(60, 0.0), expected;
    for (int j = 0; j < kDraws; ++j) {
      const LightTree::Choice c = tree.sample(at, rng.uniform());
      ++counts[c.light];
      ASSERT_NEAR(c.pmf() / tree.choice(at, c.light).pmf(), 1, 64 * 0x1p-23);
    }
    for (int l = 0; l < 60; ++l)
      expected.push_back(kDraws * static_cast<double>(tree.choice(at, l).pmf()));
    EXPECT_GT(chi2_test_p(counts, expected), sidak(kAlpha, kReceivers));
  }
}

/// n strata of u bring each light n pmf times, to less than two: its interval of u cuts two strata.
TEST(LightTree, StrataStayTogether) {
  Rng rng(1, Stream::test, 702, 0);
  Scene scene;
  scatter_lights(scene, 30, rng);
  const LightTree tree(bounds_of(scene));
  for (int i = 0; i < 20; ++i) {
    const Receiver at = random_receiver(rng);
    constexpr int n = 256;
    std::vector<int> counts(30, 0);
    for (int j = 0; j < n; ++j) {
      ++counts[tree.sample(at, (static_cast<float>(j) + rng.uniform()) / n).light];
    }
    for (int l = 0; l < 30; ++l) EXPECT_NEAR(counts[l], n * tree.choice(at, l).pmf(), 2.001);
  }
}

/// Light arrives from a point of the light: on the receiver's side, and the light shines there.
bool contributes(const Light& light, const Receiver& at, Rng& rng) {
  const std::optional<LightSample> s = light.sample(at.position, rng.uniform2());
  return s && (at.both_sides || dot(s->wi, at.normal) > 0);
}

TEST(LightTree, NeverZeroWhereLightArrives) {
  Rng rng(1, Stream::test, 703, 0);
  Scene scene;
  scatter_lights(scene, 40, rng);
  const LightTree tree(bounds_of(scene));
  int zero = 0, lit = 0;
  for (int i = 0; i < 2000; ++i) {
    Receiver at = random_receiver(rng);
    const int l = static_cast<int>(rng.next() % 40);
    const auto aim = scene.lights[l]->sample(at.position, rng.uniform2());
    // Half of the receivers just see some point of a light, at grazing incidence.
    if (aim && i % 2) {
      const Vec3 across = cross(aim->wi, at.normal);
      at.normal = normalize(cross(across, aim->wi) + aim->wi * (0.01f * rng.uniform()));
    }
    for (int k = 0; k < 40; ++k) {
      bool any = false;
      for (int j = 0; j < 8; ++j) any |= contributes(*scene.lights[k], at, rng);
      const bool chosen = tree.choice(at, k).pmf() > 0;
      zero += !chosen;
      lit += any;
      EXPECT_TRUE(chosen || !any) << i << ' ' << k;
    }
  }
  EXPECT_GT(lit, 20000);
  EXPECT_GT(zero, 10000);  // and much is left out that brings nothing
}

/// Unoccluded irradiance on the receiver by one sample of `choice`.
double irradiance(const LightSampler::Choice& choice, const Receiver& at, Vec2 u) {
  const std::optional<LightSample> s = choice.sample(at.position, u);
  if (!s) return 0;
  const float cosine = at.both_sides ? std::abs(dot(s->wi, at.normal)) : dot(s->wi, at.normal);
  if (!(cosine > 0)) return 0;
  return static_cast<double>(mean(s->radiance) * cosine) /
         (static_cast<double>(s->pdf_w) * static_cast<double>(choice.pmf));
}

/// Area lights, quadrics, points and, but for two lights, a sky.
TEST(LightTree, BringsTheLightThatUniformChoiceBrings) {
  for (const int count : {1, 2, 12, 1000}) {
    Rng rng(1, Stream::test, 704, static_cast<std::uint64_t>(count));
    Scene scene;
    scatter_lights(scene, count, rng);
    if (count != 2) {
      auto sky = make_constant_light(Rgb(0.3f));
      sky->set_scene_bounds({2, 1, 2}, 4);
      scene.environment.push_back(sky.get());
      scene.lights.push_back(std::move(sky));
    }
    const LightSampler sampler(scene);
    const auto n = static_cast<std::uint32_t>(scene.lights.size());
    for (int r = 0; r < 6; ++r) {
      const Receiver at = random_receiver(rng);
      Running difference;
      for (int i = 0; i < 15000; ++i) {
        const Vec2 u = rng.uniform2();
        const double by_tree = irradiance(sampler.sample(at, rng.uniform()), at, u);
        const LightSampler::Choice uniform{scene.lights[rng.next() % n].get(),
                                           1 / static_cast<float>(n)};
        difference.add(by_tree - irradiance(uniform, at, rng.uniform2()));
      }
      if (difference.variance() == 0) continue;  // a receiver that all light is behind
      const double z = difference.z(0);
      EXPECT_GT(z_test_p(z), sidak(kAlpha, 24)) << count << ": z " << z;
    }
  }
}

TEST(LightTree, LightsInOnePlaceFarAwayOrOfAllPowers) {
  std::vector<LightBounds> lights(300, {{{{1, 2, 3}, {1, 2, 3}}}, 1});
  lights.push_back({{{{1e18f, 0, 0}, {1e18f, 0, 0}}}, 1e-30});
  lights.push_back({{{{-1e18f, 0, 0}, {-1e18f, 0, 0}}}, 1e30});
  const LightTree tree(lights);
  for (const Vec3 x : {Vec3{1, 2, 3}, Vec3{1e18f, 0, 0}, Vec3{0, 1e19f, 0}, Vec3{0, 0, 0}}) {
    double sum = 0;
    for (int l = 0; l < 302; ++l) {
      const float pmf = tree.choice({x, {0, 0, 1}, true}, l).pmf();
      EXPECT_GT(pmf, 0);
      sum += static_cast<double>(pmf);
    }
    EXPECT_NEAR(sum, 1, 1e-5);
  }
}

TEST(LightTree, KnowsNearFromFarFrontFromBack) {
  const auto lamp = [](float x, float y) { return LightBounds{{{{x, y, 0}, {x, y, 0}}}, 1}; };
  const LightTree tree(std::vector<LightBounds>{lamp(0, 1), lamp(10, 1), lamp(1, -1)});
  const Receiver at{{0, 0, 0}, {0, 1, 0}};
  EXPECT_GT(tree.choice(at, 0).pmf(), 0.8f);
  EXPECT_GT(tree.choice(at, 1).pmf(), 0.0f);
  EXPECT_EQ(tree.choice(at, 2).pmf(), 0.0f);
  EXPECT_GT(tree.choice({{10, 0, 0}, {0, 1, 0}}, 1).pmf(), 0.8f);
  EXPECT_GT(tree.choice({{0, 0, 0}, {0, 1, 0}, true}, 2).pmf(), 0.1f);
}

}  // namespace
}  // namespace octolux
