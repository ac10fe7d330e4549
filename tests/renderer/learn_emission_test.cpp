// Learned emission: photons go where the eye looks, flux stays what it was, and nothing depends on
// threads or on where a render was interrupted.
#include "renderer/learn_emission.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "renderer/checkpoint.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// A closed room around the camera with a lamp of 4 pi W, and 2000 lamps like it in a closed
/// stadium that no light leaves, 50 m away.
std::unique_ptr<Scene> stadium() {
  std::string lamps;
  for (int i = 0; i < 2000; ++i) {
    lamps += "<emitter type='point'><point name='position' x='" +
             std::to_string(40 + i % 50 * 0.4) + "' y='" + std::to_string(i / 50 * 0.1) +
             "' z='0'/></emitter>";
  }
  return scene_from("<scene version='3.0.0'>" + sensor_xml("0, 0, 0.9", "0, 0, -1", 70, 8, 8) +
                    "<shape type='cube'><boolean name='flip_normals' value='true'/></shape>"
                    "<shape type='cube'><boolean name='flip_normals' value='true'/>"
                    "<transform name='to_world'><scale value='20'/><translate x='50'/></transform>"
                    "</shape>" +
                    lamps + "<emitter type='point'><point name='position' y='0.5'/></emitter>" +
                    "</scene>");
}

// The rooms, a little wider than their walls' insides.
constexpr Bounds kStadiumRoom{{-1.01f, -1.01f, -1.01f}, {1.01f, 1.01f, 1.01f}};
constexpr Bounds kDaylightRoom{{-2.51f, -0.01f, -2.01f}, {2.51f, 2.81f, 2.01f}};

bool inside(const Bounds& room, Vec3 p) {
  return max(room.lower, p) == p && min(room.upper, p) == p;
}

/// Photons stored in the room, and their flux [W] and that of all others.
struct Census {
  double count = 0, inside = 0, outside = 0;
};
Census census(const Scene& scene, const PhotonSource& source, std::int64_t photons, PassKey key) {
  const Bounds& room = !scene.environment.empty() ? kDaylightRoom : kStadiumRoom;
  Census c;
  for (const Photon& p : trace_photons(scene, source, PhotonKind::global, photons, key).photons) {
    const bool here = inside(room, p.position);
    c.count += here;
    (here ? c.inside : c.outside) += static_cast<double>(p.flux.g);
  }
  return c;
}

TEST(LearnEmission, AStadiumNextDoorDoesNotStarveTheRoom) {
  const auto scene = stadium();
  scene->max_depth = 2;  // first hits alone: each photon is stored once
  const LightSampler lights(*scene);
  const EmissionDensity uniform,
      learned = learn_emission(*scene, lights, photon_config(1, 20'000)).global;
  ASSERT_FALSE(learned.uniform());
  Running inside, outside;
  double count = 0, count_before = 0;
  for (std::uint64_t pass = 0; pass < 40; ++pass) {
    const Census now = census(*scene, {lights, learned}, 2'000, {1, pass});
    inside.add(now.inside);
    outside.add(now.outside);
    count += now.count;
    count_before += census(*scene, {lights, uniform}, 2'000, {1, pass}).count;
  }
  EXPECT_GT(count, 100 * count_before);
  const double lamp = 4 * std::numbers::pi;
  EXPECT_GT(z_test_p(inside.z(lamp)), kAlpha / 2) << inside.mean();
  EXPECT_GT(z_test_p(outside.z(2000 * lamp)), kAlpha / 2) << outside.mean();
}

std::unique_ptr<Scene> daylight(int width, int height) {
  auto scene = shipped_scene("daylight/daylight.xml");
  resize_film(*scene, width, height);
  return scene;
}

/// Flux in the room, all bounces, learned and around where photons are read, against neither.
TEST(LearnEmission, TheRoomReceivesTheSameDaylight) {
  const auto scene = daylight(16, 12), unfocused = daylight(16, 12);
  ASSERT_TRUE(unfocused->focus);
  unfocused->set_focus(std::nullopt);
  const LightSampler lights(*scene), everywhere(*unfocused);
  const EmissionDensity uniform,
      learned = learn_emission(*scene, lights, photon_config(1, 20'000)).global;
  ASSERT_FALSE(learned.uniform());
  Running by_learned, by_uniform;
  for (std::uint64_t pass = 0; pass < 30; ++pass) {
    by_learned.add(census(*scene, {lights, learned}, 4'000, {1, pass}).inside);
    by_uniform.add(census(*unfocused, {everywhere, uniform}, 40'000, {1, pass}).inside);
  }
  const double error = std::hypot(by_learned.standard_error(), by_uniform.standard_error());
  EXPECT_GT(z_test_p((by_learned.mean() - by_uniform.mean()) / error), kAlpha)
      << by_learned.mean() << " against " << by_uniform.mean() << " +- " << error;
  EXPECT_LT(by_learned.standard_error(), by_uniform.standard_error());
}

TEST(LearnEmission, OffWhereItBringsLittle) {
  const auto scene = shipped_scene("cornell/cornell.xml");
  const LightSampler lights(*scene);
  const PhotonAim aim = learn_emission(*scene, lights, photon_config(1, 20'000));
  EXPECT_TRUE(aim.global.uniform());
  EXPECT_TRUE(aim.caustic.uniform());
  const auto room = stadium();
  RenderConfig config = photon_config(1, 20'000);
  config.photons.learn = false;
  EXPECT_TRUE(learn_emission(*room, LightSampler(*room), config).global.uniform());
  config.photons.learn = true;
  config.eye.gather = false;  // the map as it is
  EXPECT_TRUE(learn_emission(*room, LightSampler(*room), config).global.uniform());
}

/// In a corner seen from close most gather rays end where the map is not read.
TEST(LearnEmission, ACornerSeenFromCloseTeachesNothing) {
  const auto scene = scene_from(
      "<scene version='3.0.0'>" + sensor_xml("0.2, 0.1, 0.3", "-1, -1, -1", 0.5, 8, 8) +
      "<shape type='cube'><boolean name='flip_normals' value='true'/><emitter type='area'/></shape>"
      "</scene>");
  const LightSampler lights(*scene);
  EXPECT_TRUE(learn_emission(*scene, lights, photon_config(1, 20'000)).global.uniform());
}

TEST(LearnEmission, NoLightAndNothingSeen) {
  const std::string view = sensor_xml("0, 0, 9", "0, 0, 10", 40, 8, 8);  // away from everything
  const auto unseen = scene_from("<scene version='3.0.0'>" + view +
                                 "<shape type='cube'/><emitter type='constant'/></scene>");
  const auto dark = scene_from("<scene version='3.0.0'>" + view + "<shape type='cube'/></scene>");
  for (const auto* scene : {unseen.get(), dark.get()}) {
    EXPECT_TRUE(
        learn_emission(*scene, LightSampler(*scene), photon_config(1, 5'000)).global.uniform());
  }
}

TEST(LearnEmission, ThreadsDoNotMatter) {
  const auto scene = daylight(12, 9);
  const RenderConfig config = photon_config(2, 4'000);
  ASSERT_FALSE(learn_emission(*scene, LightSampler(*scene), config).global.uniform());
  std::string first;
  for (const int threads : {1, 2, 7, 7}) {
    const ThreadLimit limit(threads);
    const std::string bytes = render_film(*scene, config).to_bytes();
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads;
  }
}

TEST(LearnEmission, ARenderThatGoesOnLearnsTheSame) {
  const auto scene = daylight(12, 9);
  const RenderConfig two = photon_config(2, 4'000), four = photon_config(4, 4'000);
  Watch watch;
  const RenderResult part = render(*scene, two, watch);
  const std::string bytes = to_checkpoint(provenance(*scene, two), part.progress, part.film);
  auto restored = from_checkpoint(bytes, provenance(*scene, four), scene->film);
  ASSERT_TRUE(restored);
  const RenderResult joined = render(*scene, four, watch, std::move(restored));
  EXPECT_EQ(joined.film.to_bytes(), render_film(*scene, four).to_bytes());
}

/// With learning, without, with portals, and by the path tracer: the same mean. Blur moves light by
/// less than half a percent of the mean at these photon counts and passes.
TEST(LearnEmissionSlow, PicturesAgree) {
  const auto plain = daylight(16, 12);
  auto marked = shipped_scene("daylight/daylight-portals.xml");
  resize_film(*marked, 16, 12);
  const Running path = pass_means(*plain, path_config(20'000));
  RenderConfig unlearned = photon_config(60, 200'000);
  unlearned.photons.learn = false;
  const std::pair<const Scene*, RenderConfig> renders[] = {
      {plain.get(), photon_config(60, 100'000)},
      {marked.get(), photon_config(60, 100'000)},
      {plain.get(), unlearned}};
  for (const auto& [scene, config] : renders) {
    const Running photon = pass_means(*scene, config);
    const double error = std::hypot(path.standard_error(), photon.standard_error());
    EXPECT_NEAR(photon.mean(), path.mean(), 4 * error + 0.005 * path.mean())
        << "learn " << config.photons.learn << ", portals " << scene->portals.size() << ", +- "
        << error;
    EXPECT_LT(error, 0.03 * path.mean());
  }
}

}  // namespace
}  // namespace octolux::test
