// The two kernels that look at the geometry, region and corrected feeler: unbiased for constant
// irradiance wherever geometry says where the surface ends, at any number of photons and any
// shrink; blind to light behind walls; linear; the same at every scale.
#include <gtest/gtest.h>

#include "tests/estimators/geometry_kernels.h"

namespace octolux::test {
namespace {

constexpr float kHalf = 4;  // of the square with photons; walls and sheets are within

std::unique_ptr<Estimator> make(const std::string& kernel, int neighbours) {
  EstimatorConfig config;
  config.kernel = kernel;
  config.neighbours = neighbours;
  return make_estimator(config);
}

struct Case {
  const char* name;
  void (*build)(Room&);
  bool (*free)(Vec2);
  Vec2 low, high;  // queries between
  bool edges;      // ends in free edges, which the feeler kernel leaves to its box
};

void floor_only(Room& room) { room.floor(-20, -20, 20, 20); }
void wall(Room& room) {
  floor_only(room);
  room.wall({-20, 0}, {20, 0});
}
void corner(Room& room) {
  floor_only(room);
  room.walls({{0, 20}, {0, 0}, {20, 0}}, false);
}
void strip(Room& room) {
  wall(room);
  room.wall({-20, 0.2f}, {20, 0.2f});
}
void sheet(Room& room) { room.floor(-1, -1, 1, 1); }

const Case kCases[] = {
    {"plane", floor_only, [](Vec2) { return true; }, {-1, -1}, {1, 1}, false},
    {"wall", wall, [](Vec2 p) { return p.y > 0; }, {-1, 0.001f}, {1, 0.3f}, false},
    {"corner",
     corner,
     [](Vec2 p) { return p.x > 0 && p.y > 0; },
     {0.001f, 0.001f},
     {0.4f, 0.4f},
     false},
    {"strip",
     strip,
     [](Vec2 p) { return p.y > 0 && p.y < 0.2f; },
     {-1, 0.001f},
     {1, 0.199f},
     false},
    {"re-entrant",
     corner,
     [](Vec2 p) { return p.x < 0 || p.y < 0; },
     {-0.3f, -0.3f},
     {0.3f, -0.001f},
     false},
    {"sheet",
     sheet,
     [](Vec2 p) { return std::abs(p.x) < 1 && std::abs(p.y) < 1; },
     {-0.99f, 0.7f},
     {0.99f, 0.99f},
     true},
};

class GeometryKernels : public testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  std::string kernel_ = std::get<0>(GetParam());
  int neighbours_ = std::get<1>(GetParam());
};

/// Irradiance over look-ups with photons of their own: 1 on the free floor, `behind` elsewhere.
Running look_up(const Case& scene, const Placement& placement, const Estimator& kernel,
                float behind, float shrink) {
  constexpr int kMaps = 40, kQueries = 10, kPhotons = 8000;
  Room room(placement);
  scene.build(room);
  Running irradiance;
  Bandwidth bandwidth;
  bandwidth.shrink = shrink;
  for (int i = 0; i < kMaps; ++i) {
    Rng rng = rng_of(20, static_cast<std::uint64_t>(i));
    const PhotonMap map = floor_photons(
        room, rng, kPhotons, kHalf, [&](Vec2 p) { return scene.free(p) ? 0.5f : 0.5f * behind; });
    Running mean;  // look-ups in one map are not independent
    for (int j = 0; j < kQueries; ++j) {
      const Vec2 u = rng.uniform2();
      const Vec2 x{scene.low.x + (scene.high.x - scene.low.x) * u.x,
                   scene.low.y + (scene.high.y - scene.low.y) * u.y};
      const float turn = rng.uniform();
      mean.add(2 * FloorLookUp(room, x)(kernel, map, turn, bandwidth).radiance.g);
    }
    irradiance.add(mean.mean());
  }
  return irradiance;
}

TEST_P(GeometryKernels, UnbiasedWhereverTheSurfaceEnds) {
  const auto kernel = make(kernel_, neighbours_);
  const double alpha = sidak(kAlpha, 2 * 6 * 6);
  for (const Case& scene : kCases) {
    if (scene.edges && kernel_ == "feeler") continue;
    for (const float shrink : {1.0f, 0.5f}) {
      const Running found = look_up(scene, {1, 0.4f, 0.3f, {}}, *kernel, 0, shrink);
      EXPECT_GT(z_test_p(found.z(1)), alpha) << scene.name << " shrink " << shrink << ": "
                                             << found.mean() << " +- " << found.standard_error();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, GeometryKernels,
                         testing::Combine(testing::Values("region", "feeler"),
                                          testing::Values(5, 20, 100)));

TEST(Region, LightBehindWallsDoesNotCount) {
  Room room({1, 0.4f, 0.3f, {}});
  corner(room);
  Rng rng = rng_of(21);
  const PhotonMap map = floor_photons(room, rng, 6000, kHalf,
                                      [](Vec2 p) { return p.x > 0 && p.y > 0 ? 0.0f : 1.0f; });
  for (int i = 0; i < 100; ++i) {
    const Vec2 x{0.002f + 0.03f * static_cast<float>(i % 10),
                 0.002f + 0.03f * static_cast<float>(i / 10)};
    const float turn = rng.uniform();
    for (const char* name : {"region", "feeler"}) {
      const Estimate found = FloorLookUp(room, x)(*make(name, 30), map, turn);
      EXPECT_EQ(found.radiance.g, 0) << name;
    }
  }
}

TEST(Region, TheSameAtEveryScale) {
  for (const char* name : {"region", "feeler"}) {
    const auto kernel = make(name, 30);
    std::vector<float> first;
    for (const float scale : {1.0f, 0x1p-13f, 0x1p13f}) {
      Room room({scale, 0, 0, {}});
      corner(room);
      Rng rng = rng_of(23);
      const PhotonMap map =
          floor_photons(room, rng, 4000, kHalf, [](Vec2 p) { return p.x > 0 && p.y > 0; });
      std::vector<float> found;
      for (int i = 0; i < 50; ++i) {
        const Vec2 x{0.01f + 0.02f * static_cast<float>(i), 0.3f};
        found.push_back(FloorLookUp(room, x)(*kernel, map, 0.1f).radiance.g);
      }
      if (first.empty()) first = found;
      for (int i = 0; i < 50; ++i) {
        // The integral is in double; what is left is rounding of sums of 30 terms.
        EXPECT_NEAR(found[i], first[i], 64 * 0x1p-23f * first[i]) << name << " scale " << scale;
      }
    }
  }
}

TEST(Region, WithoutGeometryTheWholeDiscCounts) {
  Room room;
  wall(room);
  Rng rng = rng_of(24);
  const PhotonMap map = floor_photons(room, rng, 8000, kHalf, [](Vec2) { return 1.0f; });
  Running blind;
  for (int i = 0; i < 20; ++i) {
    const Vec2 x{-1 + 0.1f * static_cast<float>(i), 0.001f};
    blind.add(FloorLookUp(room, x).blind(*make("region", 50), map).radiance.g);
  }
  EXPECT_NEAR(blind.mean(), 1, 0.2);  // as if there were no wall: photons behind it count
}

TEST(Region, FewPhotonsPhotonsAtAPointAndNone) {
  Room room;
  sheet(room);
  for (const char* name : {"region", "feeler"}) {
    for (const int n : {0, 1, 2, 5}) {
      for (const float spread : {0.0f, 0.1f}) {
        Rng rng = rng_of(25, static_cast<std::uint64_t>(n));
        std::vector<Photon> photons;
        for (int i = 0; i < n; ++i) {
          const Vec2 u = rng.uniform2();
          photons.push_back({{0.9f + spread * (u.x - 0.5f), 0.2f + spread * u.y, 0},
                             {0, 0, 1},
                             {0, 0, 1},
                             Rgb(1),
                             1});
        }
        for (const int wanted : {1, 3, 50}) {
          const FloorLookUp look(room, {0.9f, 0.2f});
          const Rgb found = look(*make(name, wanted), PhotonMap(photons), 0.6f).radiance;
          EXPECT_TRUE(std::isfinite(found.g) && found.g >= 0) << name << " of " << n;
        }
      }
    }
  }
}

TEST(Region, SmallSurfacesAreTakenWhole) {
  Room room;  // a shelf too small for its photons: all of it counts, and no more
  room.floor(0, 0, 0.1f, 0.5f);
  Running irradiance;
  for (int i = 0; i < 200; ++i) {
    Rng rng = rng_of(26, static_cast<std::uint64_t>(i));
    const PhotonMap map = floor_photons(room, rng, 40000, kHalf, [](Vec2 p) {
      return p.x > 0 && p.x < 0.1f && p.y > 0 && p.y < 0.5f ? 1.0f : 0.0f;
    });
    const Estimate found = FloorLookUp(room, {0.05f, 0.2f})(*make("region", 200), map, 0.3f);
    irradiance.add(found.radiance.g);
  }
  EXPECT_GT(z_test_p(irradiance.z(1)), kAlpha) << irradiance.mean();
}

// A bump map tilts the shading normal. Where the surface is, and who lights it, does not follow.
TEST(Region, ShadingNormalsFarFromGeometricChangeNothing) {
  Room room({1, 0.4f, 0.3f, {}});
  corner(room);
  Rng rng = rng_of(27);
  const PhotonMap map = floor_photons(room, rng, 6000, kHalf,
                                      [](Vec2 p) { return p.x > 0 && p.y > 0 ? 1.0f : 0.1f; });
  const auto white = make_diffuse(Color(Rgb(1)));
  const auto two_sided = make_two_sided(*white, *white);
  for (const char* name : {"octobox", "region", "feeler"}) {
    const auto kernel = make(name, 50);
    for (const Vec2 tilt : {Vec2{3, 0}, Vec2{-2, 2}, Vec2{0.1f, -8}}) {
      SurfacePoint point = room.look_down({0.05f, 0.1f}).value();
      const auto look = [&] {
        const Scattering at(point, *two_sided, room.placement().vector({0, 0, 1}),
                            Carried::radiance);
        return kernel->estimate({at, 255, &room.caster(), 0.3f}, map, {});
      };
      const Estimate flat = look();
      point.ns = normalize(point.ng + room.placement().vector({tilt.x, tilt.y, 0}));
      const Estimate bumped = look();
      EXPECT_EQ(bumped.count, flat.count) << name;
      EXPECT_EQ(bumped.bandwidth, flat.bandwidth) << name;
      EXPECT_NEAR(bumped.area, flat.area, 8 * 0x1p-23f * flat.area) << name;  // sums differ
      EXPECT_TRUE(is_finite(bumped.radiance) && bumped.radiance.g >= 0) << name;
    }
  }
}

}  // namespace
}  // namespace octolux::test
