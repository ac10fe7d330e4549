// The choice among lights: pmfs as documented, counts as the pmfs say.
#include "renderer/light_sampler.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "core/rng.h"
#include "renderer/scene.h"
#include "tests/core/light_meshes.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

Shape square(float side, int light) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Shape shape;
  shape.geometry = mesh;
  shape.light = light;
  return shape;
}

/// Shapes 0 and 2 shine (3 pi and 1 pi W), 3 is black; a point light of 4 pi W; sky of 2 pi W.
void fill(Scene& scene) {
  scene.shapes = {square(1, 0), square(1, -1), square(0.5f, 2), square(1, 3)};
  scene.lights.push_back(make_area_light(scene.shapes[0], Rgb(3)));
  scene.lights.push_back(make_point_light({0, 0, 1}, {0, 0, 3}));  // mean of channels: 4 pi
  scene.lights.push_back(make_area_light(scene.shapes[2], Rgb(4)));
  scene.lights.push_back(make_area_light(scene.shapes[3], Rgb(0)));
  auto sky = make_constant_light(Rgb(0.5f));
  sky->set_scene_bounds({}, std::sqrt(kInvPi));
  scene.environment.push_back(sky.get());
  scene.lights.push_back(std::move(sky));
}

double share_p(const Scene& scene, const std::vector<double>& pmf,
               const std::function<LightSampler::Choice(float)>& choose) {
  constexpr int kDraws = 100000;
  std::vector<double> counts(pmf.size(), 0.0), expected;
  Rng rng(1, Stream::test, 90, 0);
  for (int i = 0; i < kDraws; ++i) {
    const LightSampler::Choice c = choose(rng.uniform());
    for (std::size_t l = 0; l < pmf.size(); ++l) {
      if (scene.lights[l].get() != c.light) continue;
      ++counts[l];
      EXPECT_FLOAT_EQ(c.pmf, static_cast<float>(pmf[l]));
    }
  }
  for (const double p : pmf) expected.push_back(p * kDraws);
  return chi2_test_p(counts, expected);
}

constexpr Receiver kAbove{{0.3f, 0.4f, 0.5f}, {0, 0, -1}, true};

/// The sky has half of its share of power, and half of one of two kinds; the tree has the rest.
TEST(LightSampler, ChoosesAsDocumented) {
  Scene scene;
  fill(scene);
  const LightSampler sampler(scene);
  const std::vector<double> power{0.3, 0.4, 0.1, 0, 0.2};
  std::vector<double> direct{sampler.pmf_of_shape(kAbove, 0), 0, sampler.pmf_of_shape(kAbove, 2), 0,
                             0.25 + 0.5 * 0.2};
  direct[1] = 1 - direct[0] - direct[2] - direct[4];
  EXPECT_GT(share_p(scene, direct, [&](float u) { return sampler.sample(kAbove, u); }), kAlpha);
  EXPECT_GT(share_p(scene, power, [&](float u) { return sampler.sample_for_emission(u); }), kAlpha);
  EXPECT_EQ(sampler.pmf_of_shape(kAbove, 1), 0);
  EXPECT_EQ(sampler.pmf_of_shape(kAbove, 3), 0);
  const EnvironmentLight& sky = *scene.environment.front();
  EXPECT_FLOAT_EQ(sampler.pdf_w(kAbove, sky, {0, 0, 1}), 0.35f * sky.pdf_w({0, 0, 1}));
  EXPECT_NEAR(sampler.total_power(), 10 * std::acos(-1.0), 1e-5);
}

/// A ball of many triangles over a square, and a point light.
void fill_with_mesh(Scene& scene) {
  scene.shapes = {ball_mesh({0, 0, 1}, 0.5f, 6), square(1, 1)};
  scene.shapes[0].light = 0;
  scene.lights.push_back(make_area_light(scene.shapes[0], Rgb(1, 2, 3)));
  scene.lights.push_back(make_area_light(scene.shapes[1], Rgb(0.1f)));
  scene.lights.push_back(make_point_light({1, 0, 1}, Rgb(0.2f)));
  scene.bounds = bounds(scene.shapes[0]);  // of which the ball is all: cut into 64 parts
}

TEST(LightSampler, PartsOfAMeshAreChosenAsItSays) {
  Scene scene;
  fill_with_mesh(scene);
  const LightSampler sampler(scene);
  const auto triangles = std::get<TriangleMesh>(scene.shapes[0].geometry).triangles.size();
  constexpr int kDraws = 100000, kParts = 64;
  for (const Receiver& at : {kAbove, Receiver{{0.1f, 0.8f, 0.9f}, {0, -1, 0}}}) {
    std::vector<double> counts(kParts + 1, 0.0), expected(kParts + 1, 0.0);
    const MeshParts* parts = nullptr;
    Rng rng(1, Stream::test, 92, 0);
    for (int i = 0; i < kDraws; ++i) {
      const LightSampler::Choice c = sampler.sample(at, rng.uniform());
      ++counts[c.parts ? c.part : kParts];
      const auto s = c.sample(at.position, rng.uniform2());
      if (!c.parts || !s) continue;
      parts = c.parts;
      const auto& light = static_cast<const AreaLight&>(*c.light);
      ASSERT_NEAR(c.pmf * s->pdf_w / sampler.pdf_w(at, light, s->at), 1, 64 * 0x1p-23f);
    }
    ASSERT_TRUE(parts && parts->size() == kParts);
    for (std::uint32_t t = 0; t < triangles; ++t) {
      expected[parts->part_of(t)] = kDraws * static_cast<double>(sampler.pmf_of_shape(at, 0, t));
    }
    expected[kParts] = kDraws - std::accumulate(expected.begin(), expected.end(), 0.0);
    EXPECT_GT(expected[kParts], 0);
    EXPECT_GT(chi2_test_p(counts, expected), sidak(kAlpha, 2));
  }
}

/// Unoccluded irradiance, against points uniform over the ball.
TEST(LightSampler, PartsBringTheLightOfTheMeshWithLessVariance) {
  Scene scene;
  scene.shapes = {ball_mesh({0, 0, 1}, 0.5f, 6)};
  scene.shapes[0].light = 0;
  scene.lights.push_back(make_area_light(scene.shapes[0], Rgb(1, 2, 3)));
  scene.bounds = bounds(scene.shapes[0]);
  const LightSampler sampler(scene);
  Rng rng(1, Stream::test, 93, 0);
  const Receiver at{{0.3f, 0.4f, 0.2f}, {0, 0, 1}};
  const auto value = [&](const std::optional<LightSample>& s, float pmf) {
    if (!s) return 0.0;
    const float cosine = std::max(0.0f, dot(s->wi, at.normal));
    return static_cast<double>(s->radiance.g * cosine / (s->pdf_w * pmf));
  };
  Running by_parts, by_area;
  for (int i = 0; i < 20000; ++i) {
    const LightSampler::Choice c = sampler.sample(at, rng.uniform());
    by_parts.add(value(c.sample(at.position, rng.uniform2()), c.pmf));
    by_area.add(value(scene.lights[0]->sample(at.position, rng.uniform2()), 1));
  }
  const double variance = by_parts.variance_of_mean() + by_area.variance_of_mean();
  EXPECT_GT(z_test_p((by_parts.mean() - by_area.mean()) / std::sqrt(variance)), kAlpha);
  EXPECT_LT(by_parts.variance(), by_area.variance() / 3);
}

TEST(LightSampler, PhotonFluxOverPmfIsTheTotalPowerForGreyLights) {
  Scene scene;
  fill(scene);
  const LightSampler sampler(scene);
  Rng rng(1, Stream::test, 91, 0);
  for (int i = 0; i < 1000; ++i) {
    const LightSampler::Choice c = sampler.sample_for_emission(rng.uniform());
    const EmittedPhoton photon = c.light->emit(rng.uniform2(), {0.5f, 0.5f});
    EXPECT_NEAR(mean(photon.flux) / c.pmf / sampler.total_power(), 1, 1e-6);
  }
}

/// A sun of 3 pi W and another of pi W beside the others.
TEST(LightSampler, NarrowLightsAreChosenApart) {
  Scene scene;
  for (const float irradiance : {3.0f, 1.0f}) {
    scene.lights.push_back(make_directional_light({0, 0, -1}, Rgb(irradiance)));
    scene.lights.back()->set_scene_bounds({}, 1);
  }
  const LightSampler suns(scene);
  EXPECT_EQ(suns.sample(kAbove, 0.5f).light, nullptr);
  EXPECT_EQ(suns.groups(), 0);
  EXPECT_EQ(suns.divided(4).others, 0);
  EXPECT_EQ(suns.divided(4).narrow, 4);
  fill(scene);
  const LightSampler all(scene);
  Scene without;
  fill(without);
  const LightSampler others(without);
  for (float u = 0.01f; u < 1; u += 0.05f) {
    const LightSampler::Choice chosen = all.sample(kAbove, u), same = others.sample(kAbove, u);
    EXPECT_FALSE(chosen.light->narrow());
    EXPECT_EQ(chosen.pmf, same.pmf);
  }
  const std::vector<double> narrow{0.75, 0.25};
  EXPECT_GT(share_p(scene, narrow, [&](float u) { return all.sample_narrow(u); }), kAlpha);
  EXPECT_EQ(others.sample_narrow(0.5f).light, nullptr);
  EXPECT_EQ(others.divided(4).narrow, 0);
  for (const auto& [n, on_others, on_narrow] : {std::tuple{1, 1, 1}, {2, 1, 1}, {5, 3, 2}}) {
    EXPECT_EQ(all.divided(n).others, on_others);
    EXPECT_EQ(all.divided(n).narrow, on_narrow);
  }
}

TEST(LightSampler, NoLightOrNoPower) {
  Scene dark;
  const LightSampler none(dark);
  EXPECT_EQ(none.sample(kAbove, 0.5f).light, nullptr);
  EXPECT_EQ(none.sample_for_emission(0.5f).light, nullptr);
  EXPECT_EQ(none.pdf_w(kAbove, *make_constant_light(Rgb(1)), {0, 0, 1}), 0);
  EXPECT_FALSE(none.divided(4).any());
  EXPECT_EQ(none.total_power(), 0);
  dark.lights.push_back(make_point_light({0, 0, 0}, Rgb(0)));
  const LightSampler black(dark);
  EXPECT_EQ(black.sample(kAbove, 0.5f).light, nullptr);
  EXPECT_EQ(black.sample(kAbove, 0.5f).pmf, 0);
  EXPECT_EQ(black.sample_for_emission(0).light, nullptr);
}

TEST(LightSampler, EnormousPowerIsNotAnError) {
  Scene scene;
  scene.lights.push_back(make_point_light({0, 0, 0}, Rgb(3e38f)));
  const LightSampler sampler(scene);
  EXPECT_EQ(sampler.sample(kAbove, 0.5f).pmf, 1);
  EXPECT_EQ(sampler.sample_for_emission(0.5f).light, scene.lights[0].get());
}

}  // namespace
}  // namespace octolux
