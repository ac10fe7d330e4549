// Renders that stop and go on: the same bits as without a break, and nothing else is taken for one.
#include "renderer/checkpoint.h"

#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux {
namespace {

std::unique_ptr<Scene> small_scene() {
  auto scene = test::shipped_scene("cornell/cornell.xml");
  test::resize_film(*scene, 12, 9);
  return scene;
}

RenderConfig config_of(Integrator integrator, int passes) {
  RenderConfig config;
  config.integrator = integrator;
  config.photons.global = config.photons.caustic = 500;
  config.stop.passes = passes;
  return config;
}

RenderResult run(const Scene& scene, const RenderConfig& config,
                 std::optional<RenderResult> start = {}) {
  test::Watch watch;
  return render(scene, config, watch, std::move(start));
}

class Checkpoint : public ::testing::TestWithParam<Integrator> {};

TEST_P(Checkpoint, GoesOnBitByBit) {
  const auto scene = small_scene();
  const RenderConfig five = config_of(GetParam(), 5), two = config_of(GetParam(), 2);
  const RenderResult whole = run(*scene, five);
  const RenderResult part = run(*scene, two);
  EXPECT_EQ(provenance(*scene, five), provenance(*scene, two));  // stop rules do not matter

  const std::string bytes = to_checkpoint(provenance(*scene, two), part.progress, part.film);
  std::optional<RenderResult> restored =
      from_checkpoint(bytes, provenance(*scene, five), scene->film);
  ASSERT_TRUE(restored);
  EXPECT_EQ(restored->progress.seconds, part.progress.seconds);
  const RenderResult joined = run(*scene, five, std::move(restored));
  EXPECT_EQ(joined.film.to_bytes(), whole.film.to_bytes());
  EXPECT_NE(part.film.to_bytes(), whole.film.to_bytes());
  EXPECT_EQ(joined.progress.passes, 5);
  EXPECT_EQ(joined.progress.rays, whole.progress.rays);
  EXPECT_GT(joined.progress.seconds, part.progress.seconds);
}

TEST_P(Checkpoint, AFinishedRenderIsLeftAlone) {
  const auto scene = small_scene();
  const RenderConfig config = config_of(GetParam(), 2);
  const RenderResult done = run(*scene, config);
  const RenderResult again = run(*scene, config, done);
  EXPECT_EQ(again.progress.passes, 2);
  EXPECT_EQ(again.film.to_bytes(), done.film.to_bytes());
}

INSTANTIATE_TEST_SUITE_P(Integrators, Checkpoint,
                         ::testing::Values(Integrator::photon, Integrator::path));

TEST(CheckpointBytes, DamageAndStrangersAreRefused) {
  const auto scene = small_scene();
  const RenderConfig config = config_of(Integrator::photon, 1);
  const RenderResult result = run(*scene, config);
  const std::string of = provenance(*scene, config);
  const std::string bytes = to_checkpoint(of, result.progress, result.film);
  EXPECT_TRUE(from_checkpoint(bytes, of, scene->film));
  for (std::size_t at = 0; at < bytes.size(); at += 41) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    EXPECT_FALSE(from_checkpoint(damaged, of, scene->film)) << at;
    EXPECT_FALSE(from_checkpoint(bytes.substr(0, at), of, scene->film)) << at;
  }
  RenderConfig other = config;
  other.estimator.kernel = "cone";
  EXPECT_FALSE(from_checkpoint(bytes, provenance(*scene, other), scene->film));
  EXPECT_FALSE(from_checkpoint(bytes, of, {9, 12, 0, 0, 9, 11}));
}

TEST(Provenance, HoldsWhatFixesThePixels) {
  const auto scene = small_scene();
  const std::string of = provenance(*scene, config_of(Integrator::photon, 1));
  EXPECT_NE(of.find("photons.global 500\n"), std::string::npos) << of;
  EXPECT_NE(of.find("film 12x9 "), std::string::npos);
  EXPECT_EQ(of.find("stop."), std::string::npos);
  RenderConfig path = config_of(Integrator::path, 1), other = path;
  other.photons.global = 7;  // which no path tracer looks at
  EXPECT_EQ(provenance(*scene, path), provenance(*scene, other));
  other.seed = 2;
  EXPECT_NE(provenance(*scene, path), provenance(*scene, other));
}

}  // namespace
}  // namespace octolux
