// What each scene for a figure of the paper (Tobler & Maierhofer 2006) is for, in numbers: where
// the disc loses light or finds light of the next room, and which kernel does not. A camera close
// above a spot stands for the picture's pixels there; passes are equally wide (alpha = 1), so their
// means are independent samples of one number.
#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// The photon map itself, as tools/figures shows it.
RenderConfig map_config(const char* kernel, std::int64_t photons, int neighbours, int passes = 8) {
  RenderConfig config = photon_config(passes, photons);
  config.eye.gather = false;
  config.photons.alpha = 1;
  config.estimator.kernel = kernel;
  config.estimator.neighbours = neighbours;
  return config;
}

RenderConfig published(RenderConfig config) {
  config.estimator.correction = false;
  return config;
}

/// Points the camera at a spot of the scene from `above` it, so that the picture, 4 x 4 pixels,
/// shows about 3 cm.
void aim(Scene& scene, Vec3 spot, Vec3 above) {
  scene.camera_config = {};
  scene.camera_config.to_world = look_at(spot + above, spot, {0.3f, 0.2f, 0.9f}).value();
  scene.camera_config.fov_x_degrees = 2 * 57.29578f * std::atan(0.015f / length(above));
  resize_film(scene, 4, 4);
}

/// Radiance at the spot: the mean over passes.
Running seen(Scene& scene, Vec3 spot, Vec3 above, const RenderConfig& config) {
  aim(scene, spot, above);
  return pass_means(scene, config);
}

/// Is `a` below `share` times `b`, beyond the noise of both?
bool below(const Running& a, double share, const Running& b) {
  const double variance = a.variance_of_mean() + share * share * b.variance_of_mean();
  return (share * b.mean() - a.mean()) / std::sqrt(variance) > 4;
}

/// How far an estimate may be from the truth: by the kernel's own bias (estimators/README.md), by
/// the change of the light within the look-up, which is all that `region` is off by, as it knows
/// the area exactly, and by noise.
double tolerance(double own_bias, const Running& estimate, const Running& region,
                 const Running& truth) {
  const double variance = estimate.variance_of_mean() + region.variance_of_mean();
  return own_bias * truth.mean() + std::abs(region.mean() - truth.mean()) +
         4 * std::sqrt(variance + truth.variance_of_mean());
}

/// `share`: of the light at the spot that a disc can find there, and a little more.
void expect_shadow_leak(Vec3 spot, Vec3 above, double share) {
  const auto scene = shipped_scene("wall-and-corner/wall-and-corner.xml");
  const auto estimate = [&](const char* kernel) {
    return seen(*scene, spot, above, map_config(kernel, 30'000, 100, 16));
  };
  const Running truth = seen(*scene, spot, above, path_config(256));
  const Running octobox = estimate("octobox");
  EXPECT_TRUE(below(estimate("cone"), share, truth));
  EXPECT_NEAR(octobox.mean(), truth.mean(), tolerance(0.027, octobox, estimate("region"), truth));
}

TEST(FigureScenes, Wall) { expect_shadow_leak({0, 0, -1.98f}, {0, 0.5f, 0.2f}, 0.75); }

TEST(FigureScenes, Corner) { expect_shadow_leak({-1.98f, 0, -1.98f}, {0.2f, 0.5f, 0.2f}, 0.45); }

TEST(FigureScenes, ThinWall) {
  for (const char* thickness : {"0.02", "0.001"}) {
    const auto scene = shipped_scene("thin-wall/thin-wall.xml", {{"wall", thickness}});
    const Vec3 dark_floor{0.05f, 0, 0}, above{0.1f, 0.6f, 0};
    EXPECT_EQ(seen(*scene, dark_floor, above, path_config(256)).mean(), 0);
    for (const char* kernel : {"cone", "octobox"}) {
      const Running leak = seen(*scene, dark_floor, above, map_config(kernel, 10'000, 100));
      EXPECT_GT(leak.z(0), 4) << kernel;
    }
    for (const char* kernel : {"feeler", "region"}) {
      const Running none = seen(*scene, dark_floor, above, map_config(kernel, 10'000, 100));
      EXPECT_EQ(none.mean(), 0) << kernel;
    }
  }
}

TEST(FigureScenes, NothingLeaksAnywhereInTheDarkRoom) {
  const auto scene = shipped_scene("thin-wall/thin-wall.xml");
  scene->film = {64, 36, 30, 0, 34, 36};  // right of the partition
  scene->camera = Camera(scene->camera_config, scene->film);
  EXPECT_EQ(pass_means(*scene, path_config(4)).mean(), 0);
  EXPECT_EQ(pass_means(*scene, map_config("region", 10'000, 100, 2)).mean(), 0);
  EXPECT_GT(pass_means(*scene, map_config("cone", 10'000, 100, 2)).mean(), 0);
}

TEST(FigureScenes, Stairs) {
  const auto scene = shipped_scene("stairs/stairs.xml", {{"turn", "0"}});
  const Vec3 riser{0.6f, 0.425f, -0.56f}, before{0, 0.1f, 0.4f};
  const auto estimate = [&](const char* kernel) {
    return seen(*scene, riser, before, map_config(kernel, 20'000, 100));
  };
  const Running truth = seen(*scene, riser, before, path_config(256));
  EXPECT_TRUE(below(estimate("cone"), 0.25, truth));
  for (const char* kernel : {"octobox", "hull", "region"}) {
    EXPECT_TRUE(below(truth, 2, estimate(kernel))) << kernel << " has less than half";
  }
}

TEST(FigureScenes, Corridors) {
  const auto scene = shipped_scene("corridors/corridors.xml");
  const Vec3 corner{-0.23f, 0, -0.23f}, above{0.1f, 0.6f, 0};
  const auto estimate = [&](const char* kernel, const char* octants) {
    RenderConfig config = map_config(kernel, 60'000, 200, 16);
    config.estimator.octants = octants;
    return seen(*scene, corner, above, config);
  };
  const Running truth = seen(*scene, corner, above, path_config(1024));
  const Running region = estimate("region", "auto");
  EXPECT_TRUE(below(estimate("octobox", "one"), 0.97, truth));
  EXPECT_TRUE(below(estimate("hull", "auto"), 0.97, truth));
  for (const char* octants : {"auto", "eight"}) {
    const Running boxes = estimate("octobox", octants);
    EXPECT_NEAR(boxes.mean(), truth.mean(), tolerance(0.055, boxes, region, truth)) << octants;
  }
}

TEST(FigureScenes, Feelers) {
  const auto scene = shipped_scene("feelers/feelers.xml");
  const Vec3 by_the_wedge{-1.1f, 0, 0.6f}, by_the_shaft{0.9f, 0, -0.9f}, above{0, 0.6f, 0.1f};
  for (const Vec3 spot : {by_the_wedge, by_the_shaft}) {
    const auto leak = [&](RenderConfig config) {
      config.photons.global_radius = 2;
      return seen(*scene, spot, above, config).mean();
    };
    EXPECT_EQ(leak(path_config(64)), 0);
    EXPECT_GT(leak(map_config("cone", 20'000, 100, 4)), 0);
    EXPECT_GT(leak(published(map_config("feeler", 20'000, 100, 4))), 0);
    EXPECT_EQ(leak(map_config("feeler", 20'000, 100, 4)), 0);
    EXPECT_EQ(leak(map_config("region", 20'000, 100, 4)), 0);
  }
}

// The hall has no window: walls and floor are lit round two doors. Where the disc is dark along all
// edges, the region is not.
TEST(FigureScenes, House) {
  const auto scene = shipped_scene("house/house.xml", {{"view", "hall"}});
  resize_film(*scene, 24, 16);
  const Image truth = render_film(*scene, path_config(512)).radiance();
  const auto error = [&](const char* kernel) {
    return rel_mse(render_film(*scene, map_config(kernel, 50'000, 50, 2)).radiance(), truth);
  };
  EXPECT_LT(error("region"), error("cone"));
}

}  // namespace
}  // namespace octolux::test
