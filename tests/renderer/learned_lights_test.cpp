// renderer/learned_lights.h, and choosing by it: chances as trials say, choices as chances say, the
// same mean whatever was learned, and shadow rays that find the lamps of their own room.
#include "renderer/learned_lights.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"
#include "renderer/direct_light.h"
#include "renderer/glance.h"
#include "tests/renderer/renders.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

constexpr Vec3 kUp{0, 0, 1};
using Trial = LearnedLights::Trial;

/// Two places far from each other, so that each is a cell of its own.
const LookUp kHere{{0, 0, 0}, kUp}, kThere{{100, 0, 0}, kUp};

LearnedLights learned(const std::vector<Trial>& trials) {
  std::vector<LookUp> seen(32, kHere);
  seen.insert(seen.end(), 32, kThere);
  return {EyeCells(seen, {50, 0, 10}), 3, trials};
}

std::vector<float> chances(const LearnedLights& lights, const LookUp& place) {
  const std::span<const float> found = lights.at(place.position, place.normal);
  return {found.begin(), found.end()};
}

TEST(LearnedLights, ChancesAreRootsOfSecondMoments) {
  std::vector<Trial> trials;
  for (int i = 0; i < 6; ++i) trials.push_back({kHere, 0, 1.0f});      // 6 / (6 + 2)
  for (int i = 0; i < 6; ++i) trials.push_back({kHere, 2, i * 1.0f});  // 55 / (6 + 2)
  for (int i = 0; i < 9; ++i) trials.push_back({kHere, 1, 0.0f});
  const double a = std::sqrt(6 / 8.0), b = std::sqrt(55 / 8.0);
  const auto first = static_cast<float>(a / (a + b));
  EXPECT_EQ(chances(learned(trials), kHere), (std::vector<float>{first, first, 1}));
}

TEST(LearnedLights, CellsKnowTheirOwnTrials) {
  const LearnedLights lights = learned({{kThere, 1, 5.0f}});
  EXPECT_EQ(chances(lights, kThere), (std::vector<float>{0, 1, 1}));
  EXPECT_EQ(chances(lights, kHere), (std::vector<float>{0, 0, 0}));
  EXPECT_TRUE(lights.at({50, 0, 0}, kUp).empty());
  EXPECT_TRUE(lights.at(kHere.position, -kUp).empty());
  EXPECT_TRUE(LearnedLights().at(kHere.position, kUp).empty());
}

TEST(LearnedLights, WhatIsNotFiniteOrNoChoiceIsLeftOut) {
  const LearnedLights lights =
      learned({{kHere, 0, kInfinity}, {kHere, 0, NAN}, {kHere, -1, 1.0f}, {kHere, 2, 1.0f}});
  EXPECT_EQ(chances(lights, kHere), (std::vector<float>{0, 0, 1}));
}

/// A closed room with a small lamp, and a hall next door with 99 that no place in the room sees; or
/// through a door, if it is open.
std::unique_ptr<Scene> room_beside_hall(bool open) {
  std::string xml = "<scene version='3.0.0'>" + sensor_xml("-1.9, 0, 0", "0, 0, 0", 80, 128, 128);
  const auto box = [&](float x, float y, float z, float hx, float hy, float hz) {
    xml += fmt::format(
        "<shape type='cube'><transform name='to_world'><scale x='{}' y='{}' z='{}'/>"
        "<translate x='{}' y='{}' z='{}'/></transform></shape>",
        hx, hy, hz, x, y, z);
  };
  const auto lamp = [&](float x, float y, float z, float radiance) {
    xml += fmt::format(
        "<shape type='sphere'><float name='radius' value='0.05'/><point name='center' x='{}' "
        "y='{}' z='{}'/><emitter type='area'><spectrum name='radiance' value='{}'/></emitter>"
        "</shape>",
        x, y, z, radiance);
  };
  box(8, 0, 2.1f, 10, 2, 0.1f);
  box(8, 0, -2.1f, 10, 2, 0.1f);
  box(8, 2.1f, 0, 10, 0.1f, 2);
  box(8, -2.1f, 0, 10, 0.1f, 2);
  box(-2.1f, 0, 0, 0.1f, 2, 2);
  box(18.1f, 0, 0, 0.1f, 2, 2);
  if (open) {
    box(2.1f, -0.5f, 0, 0.1f, 1.5f, 2);  // beside a door of 1 m
  } else {
    box(2.1f, 0, 0, 0.1f, 2, 2);
  }
  lamp(0, 0, 1.7f, 10);
  for (int i = 0; i < 99; ++i) {
    lamp(2.6f + 0.15f * static_cast<float>(i), 1.5f - static_cast<float>(i % 4), 1.5f, 40);
  }
  return scene_from(xml + "</scene>");
}

/// Where an eye path ends up, with what a receiver there may know.
template <class See>
void look(const Scene& scene, const LearnedLights& learned, int paths, const See& see) {
  for (int i = 0; i < paths; ++i) {
    Tracer tracer(scene, Rng(5, Stream::test, 120, static_cast<std::uint64_t>(i)));
    follow_to_smooth(tracer, random_eye_ray(scene, tracer.rng), [&](const Scattering& at) {
      Receiver lit = receiver(at);
      lit.learned = learned.at(lit.position, at.facing_normal());
      see(tracer, at, lit);
    });
  }
}

constexpr DirectStrategy kOneSample{Lobes::smooth, Lobes::smooth, {1, 0}, 1, 0};

/// The share of `draws` light samples that bring light.
double bring_light(const Scene& scene, const LightSampler& lights, const LearnedLights& learned) {
  Running share;
  look(scene, learned, 4000, [&](Tracer& tracer, const Scattering& at, const Receiver& lit) {
    const LightSampler::Choice choice = lights.sample(lit, tracer.rng.uniform());
    const Rgb brought = sample_light(tracer, choice, tracer.rng.uniform2(), at, kOneSample);
    if (choice.light) share.add(is_black(brought) ? 0 : 1);
  });
  return share.mean();
}

TEST(LearnedLights, FindTheLampsOfTheirRoom) {
  const auto scene = room_beside_hall(false);
  const LightSampler lights(*scene);
  ASSERT_GE(lights.groups(), 50);
  const LearnedLights learned = learn_lights(*scene, lights, photon_config(1, 1000));
  EXPECT_LT(bring_light(*scene, lights, {}), 0.6);
  EXPECT_GT(bring_light(*scene, lights, learned), 0.85);
}

TEST(LearnedLights, ChoicesAreAsTheirProbabilitiesSay) {
  auto scene = room_beside_hall(true);
  auto sky = make_constant_light(Rgb(0.5f));
  sky->set_scene_bounds({}, 1);
  scene->environment.push_back(sky.get());
  scene->lights.push_back(std::move(sky));
  const LightSampler lights(*scene);
  const auto groups = static_cast<std::size_t>(lights.groups());
  std::vector<float> even(groups), nothing(groups, 0.0f), few(groups, 1.0f);
  for (std::size_t g = 0; g < groups; ++g) {
    even[g] = static_cast<float>(g + 1) / static_cast<float>(groups);
  }
  few[0] = 0;
  few[1] = few[2] = 0.25f;
  Receiver at{{1.9f, 1.5f, 0}, {1, 0, 0}};  // sees most of the hall through the door
  for (const std::vector<float>& known : {std::vector<float>(), even, nothing, few}) {
    at.learned = known;
    std::vector<double> expected, counts(scene->lights.size() + 1, 0.0);
    double left = 1;
    for (const Shape& shape : scene->shapes) {
      if (shape.light < 0) continue;
      const auto index = static_cast<std::uint32_t>(&shape - scene->shapes.data());
      expected.push_back(static_cast<double>(lights.pmf_of_shape(at, index)));
      left -= expected.back();
    }
    expected.push_back(static_cast<double>(lights.pdf_w(at, *scene->environment[0], kUp) /
                                           scene->environment[0]->pdf_w(kUp)));
    left -= expected.back();
    EXPECT_GT(left, -1e-5);
    EXPECT_NEAR(left, known == nothing ? 0.875 : 0, 1e-5);
    expected.push_back(std::max(0.0, left));
    Rng rng(1, Stream::test, 121, 0);
    for (int i = 0; i < 100'000; ++i) {
      const LightSampler::Choice c = lights.sample(at, rng.uniform());
      std::size_t l = 0;
      while (l < scene->lights.size() && scene->lights[l].get() != c.light) ++l;
      ++counts[l];
      ASSERT_TRUE(!c.light || std::abs(c.pmf / expected[l] - 1) < 64 * 0x1p-23f);
    }
    for (double& e : expected) e = e < 1e-6 ? 0 : e * 100'000;
    EXPECT_GT(chi2_test_p(counts, expected), sidak(kAlpha, 4));
  }
}

TEST(LearnedLights, TheMeanIsTheSameAndTheNoiseLess) {
  const auto scene = room_beside_hall(true);
  const LightSampler lights(*scene);
  const LearnedLights knowing = learn_lights(*scene, lights, photon_config(1, 1000));
  struct Result {
    Running mean, noise;  // noise: half the squared difference of two samples at one place
  };
  const auto light = [&](const LearnedLights& learned) {
    Result result;
    look(*scene, learned, 40'000, [&](Tracer& tracer, const Scattering& at, const Receiver& lit) {
      const auto sample = [&] {
        return luminance(sample_lights(tracer, lights, at, lit, kOneSample,
                                       {kOneSample.light_samples, tracer.rng}));
      };
      const double a = sample(), b = sample();
      result.mean.add(a);
      result.noise.add(0.5 * (a - b) * (a - b));
    });
    return result;
  };
  const Result blind = light({}), learned = light(knowing);
  const double variance = blind.mean.variance_of_mean() + learned.mean.variance_of_mean();
  EXPECT_GT(z_test_p((learned.mean.mean() - blind.mean.mean()) / std::sqrt(variance)), kAlpha);
  EXPECT_LT(learned.noise.mean(), 0.5 * blind.noise.mean());
}

TEST(LearnedLights, AreTheSameOnAnyNumberOfThreads) {
  const auto scene = room_beside_hall(true);
  const LightSampler lights(*scene);
  const auto learn = [&](int threads) {
    const ThreadLimit limit(threads);
    const LearnedLights learned = learn_lights(*scene, lights, photon_config(1, 1000));
    std::vector<float> all;
    look(*scene, learned, 1000, [&](Tracer&, const Scattering&, const Receiver& lit) {
      all.insert(all.end(), lit.learned.begin(), lit.learned.end());
    });
    return all;
  };
  const std::vector<float> one = learn(1);
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one, learn(2));
  EXPECT_EQ(one, learn(7));
}

TEST(LearnedLights, LearnNothingWhereThereIsNoChoiceOrNoWish) {
  const auto hall = room_beside_hall(true);
  const LightSampler lights(*hall);
  RenderConfig config = photon_config(1, 1000);
  const auto learns = [&](const Scene& scene) {
    bool known = false;
    look(scene, learn_lights(scene, LightSampler(scene), config), 100,
         [&](Tracer&, const Scattering&, const Receiver& lit) { known |= !lit.learned.empty(); });
    return known;
  };
  EXPECT_TRUE(learns(*hall));
  EXPECT_FALSE(learns(*shipped_scene("cornell/cornell.xml")));
  config.eye.learn = false;
  EXPECT_FALSE(learns(*hall));
  config.eye.learn = true;
  config.eye.gather = false;
  EXPECT_FALSE(learns(*hall));
}

}  // namespace
}  // namespace octolux::test
