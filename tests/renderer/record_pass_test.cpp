// renderer/record_pass.h: sites lie where gather rays end, dark or not, and at every third photon.
#include "renderer/record_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "renderer/glance.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

constexpr std::int64_t kPhotons = 8192;  // paths
constexpr Bandwidth kBandwidth{1, 1};
constexpr PassKey kKey{3, 2};

using Position = std::tuple<float, float, float>;
Position position_of(Vec3 p) { return {p.x, p.y, p.z}; }

/// Two rooms: light in the left one (x < 0), the eye in the right one.
class TwoRooms : public testing::Test {
 protected:
  TwoRooms() : scene_(shipped_scene("two-rooms/two-rooms.xml")), lights_(*scene_) {
    resize_film(*scene_, 128, 128);
    config_ = photon_config(1, kPhotons);
  }
  std::vector<Vec3> sites(std::uint64_t seed) const {
    const RecordSites sites = trace_record_sites(*scene_, {lights_, EmissionDensity()}, config_,
                                                 kBandwidth, {seed, kKey.pass})
                                  .sites;
    std::vector<Vec3> found;
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      const Vec3 p = sites.point(i).position;
      if (is_finite(p)) found.push_back(p);
    }
    return found;
  }
  std::vector<Photon> photons(std::uint64_t seed) const {
    return trace_photons(*scene_, {lights_, EmissionDensity()}, PhotonKind::record,
                         record_paths(kPhotons, kBandwidth), {seed, kKey.pass})
        .photons;
  }

  std::unique_ptr<Scene> scene_;
  LightSampler lights_;
  RenderConfig config_;
};

/// The share of gather rays that end in the unlit room, by brute force.
Running in_the_dark(const Scene& scene, int paths) {
  Running dark;
  for (int i = 0; i < paths; ++i) {
    Tracer tracer(scene, Rng(1, Stream::test, 900, static_cast<std::uint64_t>(i)));
    follow_to_smooth(tracer, random_eye_ray(scene, tracer.rng), [&](const Scattering& at) {
      gather_from(tracer, at, 1,
                  [&](const Scattering& there) { dark.add(there.point().position.x > 0 ? 1 : 0); });
    });
  }
  return dark;
}

TEST_F(TwoRooms, EveryThirdPhotonIsASite) {
  std::set<Position> sites;
  for (const Vec3 p : this->sites(1)) sites.insert(position_of(p));
  const std::vector<Photon> photons = this->photons(1);
  ASSERT_GT(photons.size(), 100u);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    EXPECT_EQ(sites.contains(position_of(photons[i].position)), i % 3 == 0) << i;
  }
}

TEST_F(TwoRooms, TheOthersLieWhereGatherRaysEnd) {
  std::set<Position> photons;
  for (const Photon& p : this->photons(1)) photons.insert(position_of(p.position));
  Running dark;
  for (const Vec3 p : sites(1)) {
    if (!photons.contains(position_of(p))) dark.add(p.x > 0 ? 1 : 0);
  }
  const double looks = static_cast<double>(dark.count());
  EXPECT_NEAR(looks, 0.012 * 128 * 128 * config_.eye.gather_rays, 3);  // nothing is let out
  const Running expected = in_the_dark(*scene_, 20000);
  // The two rays of an eye path are at worst alike, so that each counts for half.
  const double variance =
      2 * dark.variance() / looks + expected.variance() / static_cast<double>(expected.count());
  EXPECT_GT(z_test_p((dark.mean() - expected.mean()) / std::sqrt(variance)), kAlpha);
}

TEST_F(TwoRooms, SitesAreTheirPassesOwn) {
  const std::vector<Vec3> first = sites(1), again = sites(1), other = sites(2);
  EXPECT_EQ(first, again);
  std::set<Position> of_first;
  for (const Vec3 p : first) of_first.insert(position_of(p));
  EXPECT_TRUE(std::none_of(other.begin(), other.end(),
                           [&](Vec3 p) { return of_first.contains(position_of(p)); }));
}

TEST_F(TwoRooms, AreAsManyAsForeseen) {
  const double photons = static_cast<double>(this->photons(1).size());
  const double sites = static_cast<double>(this->sites(1).size());
  EXPECT_LE(sites, most_record_sites(*scene_, config_.eye, photons));
  EXPECT_GE(sites, 0.99 * most_record_sites(*scene_, config_.eye, photons));
}

}  // namespace
}  // namespace octolux::test
