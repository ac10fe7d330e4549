// The feeler kernel as published (its filter is a box around the query), its options, and that with
// nothing to feel it is the octobox kernel. Its corrected form is held to the truth together with
// region's, in region_test.cpp.
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/estimators/geometry_kernels.h"

namespace octolux::test {
namespace {

EstimatorConfig config_of(const std::string& kernel, bool correction, int feelers = 8) {
  EstimatorConfig config;
  config.kernel = kernel;
  config.correction = correction;
  config.feelers = feelers;
  return config;
}

PhotonMap even_photons(const Room& room) {
  Rng rng = rng_of(30);
  return floor_photons(room, rng, 8000, 4, [](Vec2) { return 1.0f; });
}

TEST(FeelerBox, IsAsFarAwayAsTheFeelersGot) {
  Room room;
  room.floor(-20, -20, 20, 20);
  room.walls({{-1, -2}, {3, -2}, {3, 4}, {-1, 4}}, true);
  for (const int feelers : {8, 4}) {
    FeelerQuery query = query_at(room, {0, 0}, 10, 0);
    query.feelers = feelers;
    const PhotonRegion box = feeler_box(room.caster(), query);
    const auto inside = [&](float x, float y) { return box.contains(Vec3{x, y, 0}); };
    EXPECT_TRUE(inside(2.9f, 0) && inside(0, 1.9f) && inside(-0.9f, 0) && inside(0, -1.9f));
    EXPECT_FALSE(inside(3.1f, 0) || inside(0, 4.1f) || inside(-1.1f, 0) || inside(0, -2.1f));
    // The diagonal feelers meet the walls at (3, 3) and (-1, 1): an octagon is cut there, a box is
    // not.
    EXPECT_EQ(inside(2.95f, 3.5f), feelers == 4);
    EXPECT_EQ(inside(0, 2.1f), feelers == 4);
    EXPECT_TRUE(inside(2.9f, 2.9f));
  }
}

TEST(FeelerBox, FreeDirectionsHaveNoSide) {
  Room room;
  room.floor(-20, -20, 20, 20);
  const PhotonRegion box = feeler_box(room.caster(), query_at(room, {0, 0}, 1, 0));
  EXPECT_TRUE(box.contains(Vec3{100, -30, 0}));
}

TEST(Feeler, InTheOpenItIsTheOctoBox) {
  Room room;
  room.floor(-20, -20, 20, 20);
  const PhotonMap map = even_photons(room);
  for (const bool correction : {true, false}) {
    const auto feeler = make_estimator(config_of("feeler", correction));
    const auto octobox = make_estimator(config_of("octobox", correction));
    for (int i = 0; i < 20; ++i) {
      const FloorLookUp look(room, {0.1f * static_cast<float>(i) - 1, 0.3f});
      const Estimate a = look(*feeler, map, 0.2f), b = look(*octobox, map, 0.2f);
      EXPECT_EQ(a.count, b.count);
      EXPECT_NEAR(a.radiance.g, b.radiance.g, 8 * 0x1p-23f * b.radiance.g);
    }
  }
}

TEST(Feeler, PublishedFiltersPhotonsBehindAWall) {
  Room room;
  room.floor(-20, -20, 20, 20);
  room.wall({-20, 0}, {20, 0});
  Rng rng = rng_of(31);
  const PhotonMap map =  // light on the other side only
      floor_photons(room, rng, 8000, 4, [](Vec2 p) { return p.y < 0 ? 1.0f : 0.0f; });
  const FloorLookUp look(room, {0.3f, 0.05f});
  EXPECT_GT(look(*make_estimator(config_of("octobox", false)), map, 0).radiance.g, 0.1f);
  for (const int feelers : {8, 4}) {
    const auto published = make_estimator(config_of("feeler", false, feelers));
    EXPECT_EQ(look(*published, map, 0).count, 0) << feelers << " feelers";
    EXPECT_EQ(look(*make_estimator(config_of("feeler", true, feelers)), map, 0).count, 0);
  }
}

TEST(Feeler, PublishedDirectionsAreFixed) {
  Room room;
  room.floor(-20, -20, 20, 20);
  room.wall({-20, -20.1f}, {20, 20});
  const PhotonMap map = even_photons(room);
  const FloorLookUp look(room, {0.3f, 0.4f});
  const auto published = make_estimator(config_of("feeler", false));
  EXPECT_EQ(look(*published, map, 0).radiance.g, look(*published, map, 0.7f).radiance.g);
}

TEST(Feeler, RejectsOtherNumbersOfFeelers) {
  for (const int feelers : {0, 3, 16}) {
    EXPECT_THROW(make_estimator(config_of("feeler", true, feelers)), Error);
  }
}

}  // namespace
}  // namespace octolux::test
