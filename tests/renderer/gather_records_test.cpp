// renderer/gather_records.h: a record holds what a look-up there finds; in the mean that is the
// irradiance.
#include "renderer/gather_records.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/bsdf_makers.h"
#include "core/constants.h"
#include "core/rng.h"
#include "core/sampling.h"
#include "renderer/config.h"
#include "tests/renderer/record_photons.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

TriangleMesh square(Vec3 corner, Vec3 a, Vec3 b) {
  return {{corner, corner + a, corner + a + b, corner + b}, {}, {}, {{0, 1, 2}, {0, 2, 3}}};
}

/// The unit square, and a screen across it at x = 0.5, seen from both sides.
std::vector<Shape> shapes(bool screen) {
  std::vector<Shape> list;
  list.push_back({square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 0, -1, "floor"});
  if (screen) list.push_back({square({0.5f, 0, 0}, {0, 1, 0}, {0, 0, 1}), 0, -1, "screen"});
  return list;
}

SurfacePoint floor_at(Vec2 xy) {
  SurfacePoint point;
  point.position = {xy.x, xy.y, 0};
  point.ng = point.ns = kUp;
  return point;
}

/// A point of the floor as a gather ray meets it.
struct Place {
  static Rgb reflectance() { return Rgb(0.5f); }
  explicit Place(Vec2 xy) : point(floor_at(xy)), bsdf(make_diffuse(Color(reflectance()))) {}

  SurfacePoint point;
  std::unique_ptr<Bsdf> bsdf;
  Scattering at{point, *bsdf, kUp, Carried::radiance};
};

std::optional<Rgb> shared(const GatherRecords& records, const GatherPoint& at) {
  return records.radiance(at, records.nearest(at));
}

class Records : public testing::Test {
 protected:
  explicit Records(bool screen = false) : shapes_(shapes(screen)), caster_(shapes_) {
    config_.neighbours = kNeighbours;
    estimator_ = make_estimator({.kernel = "cone", .neighbours = kNeighbours});
  }
  GatherRecords make(const std::vector<Photon>& sites, const RadianceMap& map) const {
    return {RecordSites(sites_at(sites), sites, map.bandwidth(), kNeighbours, kReuse), map, caster_,
            config_};
  }
  RadianceMap map(std::vector<Photon> photons, float shrink = 1) const {
    return {PhotonMap(std::move(photons)), *estimator_, {1, shrink}};
  }

  std::vector<Shape> shapes_;
  RayCaster caster_;
  RecordConfig config_;
  std::unique_ptr<Estimator> estimator_;
};

/// Whether a record is near or none: the same is known.
TEST_F(Records, DetailsAreKnownFarFromRecords) {
  const std::vector<Photon> bars = on_bars(3000, 0.01f, rng_of(16, 0));
  const RadianceMap photons = map(bars);
  const RecordSites apart(sites_at({{{0.9f, 0.9f, 0}, kUp, kUp, Rgb(1), 1, 0, kUp}}), bars, {1, 1},
                          kNeighbours, kReuse);
  const GatherRecords far(apart, photons, caster_, config_), near = make(bars, photons);
  const Place place({0.25f, 0.5f});
  EXPECT_FALSE(shared(far, {place.at}));
  EXPECT_TRUE(far.is_detail({place.at}, far.nearest({place.at})));
  EXPECT_TRUE(near.is_detail({place.at}, near.nearest({place.at})));
  EXPECT_FALSE(GatherRecords().is_detail({place.at}, std::nullopt));
}

TEST_F(Records, HoldWhatALookUpFindsThere) {
  const RadianceMap photons = map(on_square(2000, rng_of(2, 0)));
  const std::vector<Photon> site = {{{0.4f, 0.6f, 0}, kUp, kUp, Rgb(1), 1, 0, kUp},
                                    {{0.6f, 0.4f, 0}, kUp, kUp, Rgb(1), 1, 0, kUp}};
  config_.max_segments = 2;
  const GatherRecords records = make(site, photons);
  const Place at_site({0.4f, 0.6f}), aside({0.41f, 0.6f}), other({0.6f, 0.41f});
  const std::unique_ptr<Bsdf> white = make_diffuse(Color(Rgb(1)));
  for (const int segments : {2, 1}) {
    const Scattering at(at_site.point, *white, kUp, Carried::radiance);
    const Rgb expected = Place::reflectance() * photons.radiance({at, segments});
    EXPECT_EQ(shared(records, {aside.at, segments}), expected) << segments;
    EXPECT_EQ(shared(records, {aside.at, segments}), expected) << "asked again";
    EXPECT_NE(shared(records, {other.at, segments}), expected);
  }
  // No photon has a longer path than 2, so longer ones do not differ; 0 counts none.
  EXPECT_EQ(shared(records, {aside.at, 255}), shared(records, {aside.at, 2}));
  EXPECT_EQ(shared(records, {aside.at, 0}), Rgb(0));
  const std::optional<float> bandwidth = records.bandwidth({aside.at});
  ASSERT_TRUE(bandwidth);
  EXPECT_FLOAT_EQ(*bandwidth,
                  photons.bandwidth_at({at_site.at, 3}, 64) * std::sqrt(kNeighbours / 64.0f));
  EXPECT_EQ(records.bandwidth({aside.at}), bandwidth);
}

/// Surfaces that are not diffuse scatter the record's photons by their own BSDF, from where they
/// are seen: right at the record that is what a look-up finds, whatever the kernel weighs photons
/// by.
TEST_F(Records, LendTheirPhotonsToSurfacesThatAreNotDiffuse) {
  const std::unique_ptr<Bsdf> plastic = make_rough_plastic({.plastic = {}, .alpha = 0.4f});
  SurfacePoint point = floor_at({0.02f, 0.6f});  // beside the edge: boxes differ from the disc
  point.ns = normalize(Vec3{0.1f, 0.1f, 1});
  for (const std::string& kernel : kernel_names()) {
    estimator_ = make_estimator({.kernel = kernel, .neighbours = kNeighbours});
    for (const float shrink : {1.0f, 0.7f}) {
      const RadianceMap photons = map(on_square(2000, rng_of(10, 0)), shrink);
      const GatherRecords records = make({{point.position, kUp, kUp, Rgb(1), 1, 0, kUp}}, photons);
      for (const Vec3 wo : {kUp, normalize(Vec3{1, 0, 0.5f}), normalize(Vec3{0, -1, 0.2f})}) {
        const Scattering at(point, *plastic, wo, Carried::radiance);
        const float turn = static_cast<float>(hash64(0) >> 40) * 0x1p-24f;  // of record 0, key 0
        const Rgb expected = photons.radiance({at, 255, &caster_, turn});
        ASSERT_GT(expected.r, 0);
        const std::optional<Rgb> found = shared(records, {at, 255, &caster_, 0.5f});
        ASSERT_TRUE(found) << kernel;
        EXPECT_NEAR(found->r, expected.r, 1e-5f * expected.r) << kernel << ' ' << shrink;
      }
    }
  }
}

TEST_F(Records, WithoutSitesNobodyIsServed) {
  const RadianceMap photons = map(on_square(100, rng_of(3, 0)));
  const Place place({0.5f, 0.5f});
  EXPECT_FALSE(shared(make({}, photons), {place.at}));
  EXPECT_FALSE(make({}, photons).bandwidth({place.at}));
  EXPECT_FALSE(shared(GatherRecords(), {place.at}));
}

class RecordsBehindAScreen : public Records {
 protected:
  RecordsBehindAScreen() : Records(true) {}
};

TEST_F(RecordsBehindAScreen, AreRefusedWhereTheKernelLooksAtTheGeometry) {
  const RadianceMap photons = map(on_square(2000, rng_of(4, 0)));
  const std::vector<Photon> site = {{{0.49f, 0.3f, 0}, kUp, kUp, Rgb(1), 1, 0, kUp},
                                    {{0.49f, 0.7f, 0}, kUp, kUp, Rgb(1), 1, 0, kUp}};
  const Place here({0.48f, 0.3f}), behind({0.51f, 0.3f});
  EXPECT_TRUE(shared(make(site, photons), {behind.at}));
  config_.must_see = true;
  EXPECT_TRUE(shared(make(site, photons), {here.at}));
  EXPECT_FALSE(shared(make(site, photons), {behind.at}));
}

/// Records must not know the photons: neither where they are nor how many.
TEST_F(Records, AreUnbiasedOnAnEvenPlane) {
  const Place place({0.5f, 0.5f});
  for (const float shrink : {1.0f, 0.5f}) {
    Running estimates;
    for (int i = 0; i < 4000; ++i) {
      const RadianceMap photons = map(on_square(400, rng_of(5, i)), shrink);
      const GatherRecords records = make(on_square(400, rng_of(6, i)), photons);
      const std::optional<Rgb> found = shared(records, {place.at});
      if (found) estimates.add(found->r / Place::reflectance().r);
    }
    EXPECT_GT(estimates.count(), 2000u);
    EXPECT_GT(z_test_p(estimates.z(kInvPi)), sidak(kAlpha, 2)) << shrink;
  }
}

}  // namespace
}  // namespace octolux::test
