// renderer/record_sites.h: the record that serves a point is the one brute force finds, how far it
// serves is told by the photons around, and details are known.
#include "renderer/record_sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/frame.h"
#include "tests/renderer/record_photons.h"

namespace octolux::test {
namespace {

/// [m]
float reach(const RecordSites& sites, std::uint32_t record) {
  return sites.reach(sites.spacing(sites.point(record).position, sites.point(record).ng));
}

TEST(RecordSites, TheNearestSiteThatFacesTheSameWayServes) {
  std::vector<Photon> photons = on_square(4000, rng_of(0, 0));
  for (std::size_t i = 0; i < photons.size(); i += 3) photons[i].normal = photons[i].ns = -kUp;
  const Bandwidth bandwidth{1, 1};
  const RecordSites sites(sites_at(photons), photons, bandwidth, kNeighbours, kReuse);
  for (int i = 0; i < 500; ++i) {
    const Vec2 at = rng_of(1, i).uniform2();
    const Vec3 position{at.x, at.y, 0.001f};
    float nearest2 = kInfinity;
    for (const Photon& p : photons) {
      const Vec3 d = p.position - position;
      if (p.normal.z > 0) nearest2 = std::min(nearest2, dot(d, d) + 8 * d.z * d.z);
    }
    const PhotonQuery query{.position = position, .normal = kUp};
    const std::optional<RecordSites::Found> found = sites.find(query, kUp);
    ASSERT_TRUE(found);
    const Vec3 d = sites.point(found->record).position - position;
    EXPECT_EQ(sites.point(found->record).ng, kUp);
    EXPECT_NEAR(dot(d, d) + 8 * d.z * d.z, nearest2, 1e-6f * nearest2);
    EXPECT_EQ(found->distance2, nearest2);
  }
}

/// Four others on a surface that faces the same way tell the bandwidth of a look-up for 20.
TEST(RecordSites, ReachAsFarAsThePhotonsAroundTell) {
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
      EXPECT_FLOAT_EQ(reach(sites, record), static_cast<float>(kReuse) * std::pow(shrink, 1.5f) *
                                                std::sqrt(5.0f) * distances[4]);
    }
  }
  // Of one alone nobody knows.
  const RecordSites one(sites_at({photons[1]}), {photons[1]}, {2, 0.5f}, kNeighbours, kReuse);
  EXPECT_FLOAT_EQ(reach(one, 0), static_cast<float>(kReuse) * std::pow(0.5f, 1.5f) * 2);
}

TEST(RecordSites, ReachNoLessWhereTheyLieClose) {
  const std::vector<Photon> photons = on_square(1000, rng_of(11, 0));
  std::vector<RecordSite> few = sites_at({photons[0]}), many = few;
  for (const RecordSite& s : sites_at(on_square(500, rng_of(12, 0)))) many.push_back(s);
  const PhotonQuery query{.position = photons[0].position, .normal = kUp};
  float reaches[2];
  for (int i = 0; i < 2; ++i) {
    const RecordSites sites(i == 0 ? few : many, photons, {1, 1}, kNeighbours, kReuse);
    reaches[i] = reach(sites, sites.find(query, kUp)->record);
  }
  EXPECT_EQ(reaches[0], reaches[1]);
}

TEST(RecordSites, WhatIsNotFiniteIsLeftOut) {
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
    EXPECT_EQ(reach(finite, i), reach(all, i));
  }
}

/// Brute force: of photons across the surface as many as of its own are within the distance of the
/// fourth of these.
bool is_detail(const std::vector<Photon>& photons, Vec3 position) {
  std::vector<float> own, across;
  for (const Photon& p : photons) {
    const Vec3 d = p.position - position;
    if (p.normal.z > 0.95f) own.push_back(dot(d, d) + 8 * d.z * d.z);
    if (std::abs(p.normal.z) < 0.7f) across.push_back(dot(d, d));
  }
  std::sort(own.begin(), own.end());
  std::sort(across.begin(), across.end());
  return across[3] < own[3];
}

TEST(RecordSites, KnowDetailsByThePhotonsAcross) {
  std::vector<Photon> photons = on_bars(3000, 0.02f, rng_of(13, 0));
  for (Photon& p : photons) {  // one half of the square is not barred
    if (p.position.x > 0.5f) p.position.z = 0, p.normal = p.ns = kUp;
  }
  const RecordSites sites({}, photons, {1, 1}, kNeighbours, kReuse);
  int details = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 at = rng_of(14, i).uniform2();
    const Vec3 position{at.x, at.y, 0};
    const bool detail = sites.is_detail(position, kUp, sites.spacing(position, kUp));
    EXPECT_EQ(detail, is_detail(photons, position)) << at.x << ' ' << at.y;
    EXPECT_FALSE(detail && at.x > 0.6f);
    details += detail;
  }
  EXPECT_GT(details, 300);
  EXPECT_LT(details, 600);
}

/// The back of a wall, however bright, does not make its front a detail: along the axes, where the
/// back's tree is passed over, and tilted, where it may not be.
TEST(RecordSites, AWallIsNoDetailOfItsBack) {
  for (const Vec3 front : {kUp, normalize(Vec3{0.3f, 0.5f, 1})}) {
    const Frame frame = Frame::from_normal(front);
    std::vector<Photon> photons = on_square(1000, rng_of(15, 0));
    for (std::size_t i = 0; i < photons.size(); ++i) {
      photons[i].position = frame.to_world(photons[i].position);
      photons[i].normal = photons[i].ns = i % 10 == 0 ? front : -front;
    }
    const RecordSites sites({}, photons, {1, 1}, kNeighbours, kReuse);
    const Vec3 middle = frame.to_world({0.5f, 0.5f, 0});
    EXPECT_FALSE(sites.is_detail(middle, front, sites.spacing(middle, front))) << front.z;
  }
}

}  // namespace
}  // namespace octolux::test
