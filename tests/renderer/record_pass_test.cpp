// renderer/record_pass.h: sites lie where gather rays end, dark or not, and at every third photon.
#include "renderer/record_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "core/constants.h"
#include "core/frame.h"
#include "core/sampling.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

constexpr std::int64_t kPhotons = 8192;  // paths
constexpr Bandwidth kBandwidth{1, 1};
constexpr std::uint64_t kPass = 2;

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
    const RecordPass pass = trace_record_sites(*scene_, {lights_, EmissionDensity()}, config_,
                                               kBandwidth, {seed, kPass});
    std::vector<Vec3> found;
    for (const RecordSite& site : pass.sites) found.push_back(site.position);
    return found;
  }
  std::vector<Photon> photons(std::uint64_t seed) const {
    return trace_photons(*scene_, {lights_, EmissionDensity()}, PhotonKind::record,
                         record_paths(kPhotons, kBandwidth), {seed, kPass})
        .photons;
  }

  std::unique_ptr<Scene> scene_;
  LightSampler lights_;
  RenderConfig config_;
};

/// Coordinates of places, and the share of them in the unlit room.
struct Whereabouts {
  std::array<Running, 4> of;

  void add(Vec3 p) {
    const float values[] = {p.x, p.y, p.z, p.x > 0 ? 1.0f : 0.0f};
    for (std::size_t i = 0; i < of.size(); ++i) of[i].add(values[i]);
  }
};

/// Where gather rays end, were all surfaces diffuse, as they are.
Whereabouts ends_of_gather_rays(const Scene& scene, int paths) {
  Whereabouts ends;
  for (int i = 0; i < paths; ++i) {
    Rng rng(1, Stream::test, 900, static_cast<std::uint64_t>(i));
    const Ray ray = scene.camera.ray(rng.uniform2() * static_cast<float>(scene.film.width), {0, 0});
    const SurfacePoint seen = scene.caster->surface(scene.caster->closest(ray).value());
    const Vec3 normal = dot(seen.ng, ray.direction) < 0 ? seen.ng : -seen.ng;
    const Vec3 wi = Frame::from_normal(normal).to_world(sample_cosine_hemisphere(rng.uniform2()));
    const Vec3 from = seen.position + normal * 1e-4f;
    const std::optional<RayHit> end = scene.caster->closest({from, wi, 0, kInfinity});
    ends.add(scene.caster->surface(end.value()).position);
  }
  return ends;
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
  Whereabouts found;
  for (const Vec3 p : sites(1)) {
    if (!photons.contains(position_of(p))) found.add(p);
  }
  const double looks = static_cast<double>(found.of[0].count());
  EXPECT_NEAR(looks, 0.012 * 128 * 128 * config_.eye.gather_rays, 3);  // nothing is let out
  const Whereabouts expected = ends_of_gather_rays(*scene_, 20000);
  for (std::size_t i = 0; i < found.of.size(); ++i) {
    const Running &a = found.of[i], &b = expected.of[i];
    // The two rays of an eye path are at worst alike, so that each counts for half.
    const double variance = 2 * a.variance() / looks + b.variance() / 20000;
    EXPECT_GT(z_test_p((a.mean() - b.mean()) / std::sqrt(variance)), sidak(kAlpha, 4)) << i;
  }
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
