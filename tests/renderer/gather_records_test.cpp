// renderer/record_sites.h and renderer/gather_records.h: the record that serves a point is the one
// brute force finds; it holds what a look-up there finds; in the mean that is the irradiance.
#include "renderer/gather_records.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/bsdf_makers.h"
#include "core/constants.h"
#include "core/rng.h"
#include "core/sampling.h"
#include "renderer/config.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

constexpr Vec3 kUp{0, 0, 1};
constexpr int kNeighbours = 20;
constexpr double kReuse = EyeConfig{}.reuse;

Rng rng_of(int use, int i) {
  return Rng(1, Stream::test, 810 + static_cast<std::uint64_t>(use), static_cast<std::uint64_t>(i));
}

/// Photons of flux 1 / count each on the unit square in z = 0, path lengths 1 and 2 in turn.
std::vector<Photon> on_square(int count, Rng rng) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec2 at = rng.uniform2();
    const Vec3 wi = sample_cosine_hemisphere(rng.uniform2());
    photons.push_back(
        {{at.x, at.y, 0}, wi, kUp, Rgb(1.0f / static_cast<float>(count)), 1 + i % 2, 0, kUp});
  }
  return photons;
}

std::vector<RecordSite> sites_at(const std::vector<Photon>& photons) {
  std::vector<RecordSite> sites;
  for (const Photon& p : photons) sites.push_back({p.position, p.normal, p.ns, p.error});
  return sites;
}

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

TEST_F(Records, TheNearestSiteThatFacesTheSameWayServes) {
  std::vector<Photon> photons = on_square(4000, rng_of(0, 0));
  for (std::size_t i = 0; i < photons.size(); i += 3) photons[i].normal = photons[i].ns = -kUp;
  const Bandwidth bandwidth{1, 1};
  const RecordSites sites(sites_at(photons), photons, bandwidth, kNeighbours, kReuse);
  const RecordSites near(sites_at(photons), photons, bandwidth, kNeighbours, 1e-4);
  for (int i = 0; i < 500; ++i) {
    const Vec2 at = rng_of(1, i).uniform2();
    const Vec3 position{at.x, at.y, 0.001f};
    float nearest2 = kInfinity;
    for (const Photon& p : photons) {
      const Vec3 d = p.position - position;
      if (p.normal.z > 0) nearest2 = std::min(nearest2, dot(d, d) + 8 * d.z * d.z);
    }
    const PhotonQuery query{.position = position, .normal = kUp};
    EXPECT_FALSE(near.find(query, kUp));
    const std::optional<RecordSites::Found> found = sites.find(query, kUp);
    ASSERT_TRUE(found);
    const Vec3 d = sites.point(found->record).position - position;
    EXPECT_EQ(sites.point(found->record).ng, kUp);
    EXPECT_NEAR(dot(d, d) + 8 * d.z * d.z, nearest2, 1e-6f * nearest2);
    EXPECT_EQ(found->distance2, nearest2);
  }
}

/// Four others on a surface that faces the same way tell the bandwidth of a look-up for 20.
TEST_F(Records, ReachAsFarAsThePhotonsAroundTell) {
  std::vector<Photon> photons = on_square(1000, rng_of(9, 0));
  for (std::size_t i = 0; i < photons.size(); i += 3) photons[i].normal = photons[i].ns = -kUp;
  for (const float shrink : {1.0f, 0.5f}) {
    const RecordSites sites(sites_at(photons), photons, {1, shrink}, kNeighbours, kReuse);
    for (const Vec2 at : {Vec2{0.5f, 0.5f}, Vec2{0, 0}, Vec2{0.2f, 0.9f}}) {
      const PhotonQuery query{.position = {at.x, at.y, 0}, .normal = kUp};
      const std::uint32_t record = sites.find(query, kUp)->record;
      std::vector<float> distances;
      for (const Photon& p : photons) {
        if (p.normal.z > 0) distances.push_back(length(p.position - sites.point(record).position));
      }
      std::sort(distances.begin(), distances.end());
      EXPECT_FLOAT_EQ(sites.reach(record), static_cast<float>(kReuse) * std::pow(shrink, 1.5f) *
                                               std::sqrt(5.0f) * distances[4]);
    }
  }
  // Of one alone nobody knows.
  const RecordSites one(sites_at({photons[1]}), {photons[1]}, {2, 0.5f}, kNeighbours, kReuse);
  EXPECT_FLOAT_EQ(one.reach(0), static_cast<float>(kReuse) * std::pow(0.5f, 1.5f) * 2);
}

TEST_F(Records, ReachNoLessWhereTheyLieClose) {
  const std::vector<Photon> photons = on_square(1000, rng_of(11, 0));
  std::vector<RecordSite> few = sites_at({photons[0]}), many = few;
  for (const RecordSite& s : sites_at(on_square(500, rng_of(12, 0)))) many.push_back(s);
  const PhotonQuery query{.position = photons[0].position, .normal = kUp};
  float reach[2];
  for (int i = 0; i < 2; ++i) {
    const RecordSites sites(i == 0 ? few : many, photons, {1, 1}, kNeighbours, kReuse);
    reach[i] = sites.reach(sites.find(query, kUp)->record);
  }
  EXPECT_EQ(reach[0], reach[1]);
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
    EXPECT_EQ(records.radiance({aside.at, segments}), expected) << segments;
    EXPECT_EQ(records.radiance({aside.at, segments}), expected) << "asked again";
    EXPECT_NE(records.radiance({other.at, segments}), expected);
  }
  // No photon has a longer path than 2, so longer ones do not differ; 0 counts none.
  EXPECT_EQ(records.radiance({aside.at, 255}), records.radiance({aside.at, 2}));
  EXPECT_EQ(records.radiance({aside.at, 0}), Rgb(0));
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
        const std::optional<Rgb> found = records.radiance({at, 255, &caster_, 0.5f});
        ASSERT_TRUE(found) << kernel;
        EXPECT_NEAR(found->r, expected.r, 1e-5f * expected.r) << kernel << ' ' << shrink;
      }
    }
  }
}

TEST_F(Records, WithoutSitesNobodyIsServed) {
  const RadianceMap photons = map(on_square(100, rng_of(3, 0)));
  const Place place({0.5f, 0.5f});
  EXPECT_FALSE(make({}, photons).radiance({place.at}));
  EXPECT_FALSE(make({}, photons).bandwidth({place.at}));
  EXPECT_FALSE(GatherRecords().radiance({place.at}));
}

TEST_F(Records, WhatIsNotFiniteIsLeftOut) {
  std::vector<Photon> photons = on_square(100, rng_of(8, 0));
  const RecordSites all(sites_at(photons), photons, {1, 1}, kNeighbours, kReuse);
  for (std::size_t i = 0; i < photons.size(); i += 3) {
    photons.insert(photons.begin() + static_cast<std::ptrdiff_t>(i), photons[i]);
    photons[i].position.x = i % 2 == 0 ? NAN : kInfinity;
  }
  const RecordSites finite(sites_at(photons), photons, {1, 1}, kNeighbours, kReuse);
  ASSERT_EQ(finite.size(), all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(finite.point(i).position, all.point(i).position);
    if (!is_finite(all.point(i).position)) continue;
    EXPECT_EQ(finite.reach(i), all.reach(i));
  }
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
  EXPECT_TRUE(make(site, photons).radiance({behind.at}));
  config_.must_see = true;
  EXPECT_TRUE(make(site, photons).radiance({here.at}));
  EXPECT_FALSE(make(site, photons).radiance({behind.at}));
}

/// Records must not know the photons: neither where they are nor how many.
TEST_F(Records, AreUnbiasedOnAnEvenPlane) {
  const Place place({0.5f, 0.5f});
  for (const float shrink : {1.0f, 0.5f}) {
    Running estimates;
    for (int i = 0; i < 4000; ++i) {
      const RadianceMap photons = map(on_square(400, rng_of(5, i)), shrink);
      const GatherRecords records = make(on_square(400, rng_of(6, i)), photons);
      const std::optional<Rgb> found = records.radiance({place.at});
      if (found) estimates.add(found->r / Place::reflectance().r);
    }
    EXPECT_GT(estimates.count(), 2000u);
    EXPECT_GT(z_test_p(estimates.z(kInvPi)), sidak(kAlpha, 2)) << shrink;
  }
}

}  // namespace
}  // namespace octolux::test
