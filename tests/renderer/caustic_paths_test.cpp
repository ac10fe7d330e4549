// How many photon paths look for caustics: as many as the picture shows caustics, and never
// otherwise than was asked for.
#include "renderer/caustic_paths.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// Caustic paths for one global path, decided as a render does.
double relative_paths(const Scene& scene, RenderConfig config = {}) {
  config = resolved(config, 10'000);
  const LightSampler lights(scene);
  const PhotonAim aim = learn_emission(scene, lights, config);
  return static_cast<double>(caustic_paths(scene, lights, aim, config)) /
         static_cast<double>(config.photons.global);
}

constexpr const char* kGlass = "<bsdf type='dielectric'/>";

/// A closed box with a lamp of 0.2 m below its ceiling, and a ball over its floor, seen from above.
std::unique_ptr<Scene> ball_in_box(const std::string& bsdf, double radius = 0.3) {
  return scene_from("<scene version='3.0.0'>" + sensor_xml("0, 0.2, 0", "0, -1, 0.01", 60, 64, 64) +
                    "<shape type='cube'><boolean name='flip_normals' value='true'/></shape>"
                    "<shape type='rectangle'><transform name='to_world'><scale value='0.1'/>"
                    "<rotate x='1' angle='90'/><translate y='0.99'/></transform>"
                    "<emitter type='area'><rgb name='radiance' value='10'/></emitter></shape>"
                    "<shape type='sphere'><point name='center' y='-0.6'/>"
                    "<float name='radius' value='" +
                    std::to_string(radius) + "'/>" + bsdf + "</shape></scene>");
}

TEST(CausticPaths, GrowWithWhatCausticsAreOfThePicture) {
  EXPECT_EQ(relative_paths(*ball_in_box(kGlass)), 16);
  const double small = relative_paths(*ball_in_box(kGlass, 0.06));
  EXPECT_GT(small, 0.25);
  EXPECT_LT(small, 16);
  // A mirror that no light meets but the camera.
  EXPECT_EQ(relative_paths(*shipped_scene("mirror/mirror.xml")), 0.25);
  // As many as others where there is nothing specular; they are not traced.
  EXPECT_EQ(relative_paths(*ball_in_box("<bsdf type='diffuse'/>")), 1);
}

TEST(CausticPaths, StayWhatWasAskedFor) {
  const auto scene = ball_in_box(kGlass);
  RenderConfig config;
  for (const std::int64_t asked : {0, 1, 12'345}) {
    config.photons.caustic = asked;
    EXPECT_EQ(relative_paths(*scene, config) * 50'000, static_cast<double>(asked));
  }
}

TEST(CausticPaths, DoNotDependOnKernelOrThreads) {
  const auto scene = ball_in_box(kGlass, 0.06);
  RenderConfig config;
  const double paths = relative_paths(*scene, config);
  for (const char* kernel : {"disc", "region"}) {
    config.estimator.kernel = kernel;
    EXPECT_EQ(relative_paths(*scene, config), paths) << kernel;
  }
  for (const int threads : {1, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(relative_paths(*scene), paths) << threads;
  }
}

/// The picture tells how many there were, and asked for so many, it is the same again.
TEST(CausticPaths, AreToldByTheRender) {
  const auto scene = ball_in_box(kGlass);
  resize_film(*scene, 16, 16);
  RenderConfig config = photon_config(1, 5'000);
  config.photons.caustic = -1;
  Progress progress;
  Watch watch([&](const Progress& p, const Film&) { progress = p; });
  const Film automatic = std::move(render(*scene, config, watch).film);
  ASSERT_GT(progress.caustic_paths, 10'000);
  config.photons.caustic = progress.caustic_paths;
  const Film asked = render_film(*scene, config);
  for (std::size_t i = 0; i < automatic.radiance().pixels.size(); ++i) {
    EXPECT_EQ(automatic.radiance().pixels[i].g, asked.radiance().pixels[i].g) << i;
  }
}

}  // namespace
}  // namespace octolux::test
