// What the camera looks at: found in rooms on wide ground, and of no use where the scene is all
// that is seen.
#include "renderer/focus.h"

#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// The daylight room on ground of `side` metres.
std::unique_ptr<Scene> daylight_on(double side) {
  std::ifstream file(std::string(OCTOLUX_SOURCE_DIR) + "/scenes/daylight/daylight.xml");
  const std::string xml{std::istreambuf_iterator<char>(file), {}};
  const std::string ground = "<scale value=\"30\"/>";
  EXPECT_NE(xml.find(ground), std::string::npos);
  auto scene = scene_from(std::string(xml).replace(
      xml.find(ground), ground.size(), "<scale value=\"" + std::to_string(side / 2) + "\"/>"));
  resize_film(*scene, 24, 18);
  return scene;
}

TEST(Focus, IsInTheRoom) {
  for (const double side : {60.0, 4000.0}) {
    const auto scene = daylight_on(side);
    ASSERT_TRUE(scene->focus) << side;
    const Vec3 c = scene->focus->center;
    EXPECT_TRUE(std::abs(c.x) < 2.5f && c.y > 0 && c.y < 2.8f && std::abs(c.z) < 2) << side;
    EXPECT_TRUE(scene->focus->radius > 0.5f && scene->focus->radius < 3.5f) << side;
  }
}

/// Of a window's glazing bar or a corner's last centimetre, too: light is read all over the room.
TEST(Focus, OfADetailIsTheRoom) {
  const auto scene = shipped_scene("daylight/daylight.xml");
  const Focus wide = scene->focus.value();
  for (const Vec3 target : {Vec3{-2.5f, 0, -2}, Vec3{1, 1, -2}}) {
    scene->camera_config.to_world = *look_at({2, 1.5f, 1}, target, {0, 1, 0});
    scene->camera_config.fov_x_degrees = 0.01f;
    scene->camera = Camera(scene->camera_config, scene->film);
    const std::optional<Focus> detail = find_focus(*scene);
    ASSERT_TRUE(detail);
    EXPECT_LT(length(detail->center - wide.center), 1.5f * wide.radius);
    EXPECT_GT(detail->radius, 0.25f * wide.radius);
    EXPECT_LT(detail->radius, 2 * wide.radius);
  }
}

TEST(Focus, IsOfNoUseWhereAllIsLit) {
  const auto closed = scene_from("<scene version='3.0.0'>" +  // a corner, seen from close
                                 sensor_xml("0.2, 0.1, 0.3", "-1, -1, -1", 0.5, 8, 8) +
                                 "<shape type='cube'><boolean name='flip_normals' value='true'/>"
                                 "<emitter type='area'/></shape></scene>");
  EXPECT_FALSE(closed->focus);
  EXPECT_FALSE(shipped_scene("cornell/cornell.xml")->focus);
  EXPECT_FALSE(scene_from("<scene version='3.0.0'>" + sensor_xml("0, 0, 9", "0, 0, 10", 40, 8, 8) +
                          "<shape type='cube'/><emitter type='constant'/></scene>")
                   ->focus);  // nothing is seen
}

/// The median over pixels of the relative variance that a render states.
double noise(const Scene& scene) {
  const Film film = render_film(scene, photon_config(8, 20'000));
  const Image image = film.radiance(), variance = film.variance();
  std::vector<double> relative;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double value = static_cast<double>(image.pixels[i].g) + 0.01;
    relative.push_back(static_cast<double>(variance.pixels[i].g) / (value * value));
  }
  std::nth_element(relative.begin(), relative.begin() + relative.size() / 2, relative.end());
  return relative[relative.size() / 2];
}

/// A room on 4000 times the ground: the same light (path tracer), and no more noise; the median of
/// 432 variances of 8 passes is known to some 3 %, and without a focus it is 1.7 times as much.
TEST(FocusSlow, WideGroundCostsNothing) {
  const auto narrow = daylight_on(60), wide = daylight_on(4000);
  EXPECT_LT(noise(*wide), 1.3 * noise(*narrow));
  const Running path = pass_means(*wide, path_config(10'000));
  const Running photon = pass_means(*wide, photon_config(60, 100'000));
  const double error = std::hypot(path.standard_error(), photon.standard_error());
  EXPECT_NEAR(photon.mean(), path.mean(), 4 * error + 0.02 * path.mean()) << error;
  EXPECT_LT(error, 0.02 * path.mean());
}

}  // namespace
}  // namespace octolux::test
