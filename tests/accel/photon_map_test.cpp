// The photon map against brute force over the same photons: equal to the last bit, in every
// arrangement that trips kd-trees up, for every filter, and for any number of threads.
#include "accel/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/parallel.h"
#include "core/rng.h"
#include "core/sampling.h"
#include "tests/stats.h"

namespace octolux {
namespace {

Rng rng_of(std::uint64_t index) { return Rng(20060131, Stream::test, 1, index); }

Vec3 random_direction(Rng& rng) { return normalize(sample_sphere(rng.uniform2())); }

Vec3 random_in_cube(Rng& rng) {
  const float x = rng.uniform();
  const float y = rng.uniform();
  const float z = rng.uniform();
  return {x, y, z};
}

/// Arrangements of positions, all within about [0, 1]^3.
enum class Layout { volume, box_faces, plane, line, point, duplicates, grid, two_clusters, count };

Vec3 place(Layout layout, Rng& rng, int i) {
  const Vec3 u = random_in_cube(rng);
  const auto step = [](float x) { return std::floor(x * 4) / 4; };
  switch (layout) {
    case Layout::box_faces: {
      const float side = static_cast<float>(i % 2);
      return i % 3 == 0   ? Vec3{side, u.y, u.z}
             : i % 3 == 1 ? Vec3{u.x, side, u.z}
                          : Vec3{u.x, u.y, side};
    }
    case Layout::plane:
      return {u.x, u.y, 0.5f};
    case Layout::line:
      return {0.25f, u.y, 0.75f};
    case Layout::point:
      return {0.3f, 0.4f, 0.5f};
    case Layout::duplicates:
      return i % 5 == 0 ? u : Vec3{0.3f, 0.4f, 0.5f};
    case Layout::grid:
      return {step(u.x), step(u.y), step(u.z)};
    case Layout::two_clusters:
      return u * 1e-3f + Vec3{static_cast<float>(i % 2), 0, 0};
    default:
      return u;
  }
}

/// Normals mostly of a few surfaces, some of curved ones; directions above them.
Photon random_photon(Layout layout, Rng& rng, int i) {
  static constexpr Vec3 kFew[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
  Photon photon;
  photon.position = place(layout, rng, i);
  const std::uint32_t choice = rng.next() % 6;
  photon.normal = choice < 4 ? kFew[choice] : random_direction(rng);
  photon.wi = random_direction(rng);
  if (dot(photon.wi, photon.normal) < 0) photon.wi = -photon.wi;
  photon.flux = {rng.uniform(), 1, 2};
  photon.segments = 1 + static_cast<int>(rng.next() % 9);
  return photon;
}

std::vector<Photon> random_photons(Layout layout, int count, std::uint64_t seed) {
  Rng rng = rng_of(seed);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) photons.push_back(random_photon(layout, rng, i));
  return photons;
}

bool counts(const PhotonMap& map, std::uint32_t photon, const PhotonQuery& query) {
  const float cosine = dot(normal(map.payload(photon)), query.normal);
  if (!((query.both_sides ? std::abs(cosine) : cosine) > 0.7f)) return false;
  if (!query.both_sides && !(dot(map.wi(photon), query.normal) > 0)) return false;
  if (query.region && !query.region->contains(map.position(photon) - query.position)) return false;
  return segments(map.payload(photon)) <= query.max_segments;
}

float distance2(const PhotonMap& map, std::uint32_t photon, const PhotonQuery& query) {
  const Vec3 d = map.position(photon) - query.position;
  const float along = dot(d, query.normal);
  return length2(d) + (query.squash * query.squash - 1) * (along * along);
}

/// All photons that count below max_radius, in the map's order.
std::vector<Neighbour> brute_force(const PhotonMap& map, const PhotonQuery& query) {
  std::vector<Neighbour> found;
  for (std::uint32_t i = 0; i < map.slots(); ++i) {
    if (!map.holds(i)) continue;
    const float d2 = distance2(map, i, query);
    if (d2 < query.max_radius * query.max_radius && counts(map, i, query)) found.push_back({d2, i});
  }
  return found;
}

using Pairs = std::vector<std::pair<float, std::uint32_t>>;
Pairs pairs_of(std::span<const Neighbour> neighbours) {
  Pairs pairs;
  for (const Neighbour& n : neighbours) pairs.emplace_back(n.distance2, n.photon);
  return pairs;
}

PhotonQuery random_query(Rng& rng, const PhotonMap& map) {
  static constexpr float kRadii[] = {1e30f, kInfinity, 0.05f, 0.5f, 0};
  PhotonQuery query;
  query.position = random_in_cube(rng) * 1.5f + Vec3{-0.25f, -0.25f, -0.25f};
  const std::uint32_t at_photon = rng.next();
  if (map.size() > 0 && at_photon % 2 == 0) {
    const std::uint32_t slot = (at_photon >> 1) % map.slots();
    if (map.holds(slot)) query.position = map.position(slot);
  }
  const std::uint32_t choice = rng.next();
  query.normal = choice % 2 == 0 ? Vec3{0, 0, 1} : random_direction(rng);
  query.max_radius = kRadii[(choice >> 1) % 5];
  query.max_segments = (choice >> 5) % 3 == 0 ? 4 : kMaxSegments;
  query.both_sides = (choice >> 10) % 4 == 0;
  query.squash = (choice >> 15) % 3 == 0 ? 1.0f : 3.0f;
  return query;
}

/// Random half planes around the query, some of them through it.
PhotonRegion random_region(Rng& rng, Vec3 normal) {
  PhotonRegion region;
  region.s = normalize(cross(normal, random_direction(rng)));
  region.t = cross(normal, region.s);
  for (PhotonRegion::Sector& sector : region.sectors) {
    for (int i = 0; i < PhotonRegion::kLines; ++i) {
      const float angle = 2 * kPi * rng.uniform();
      const float distance = 0.5f * rng.uniform();
      const std::uint32_t choice = rng.next() % 4;
      if (choice == 0) continue;
      sector.set(i, {{std::cos(angle), std::sin(angle)}, choice == 1 ? 0 : distance});
    }
  }
  return region;
}

/// Compares both kinds of look-up; returns how many neighbours were found in all.
std::size_t compare(const PhotonMap& map, const PhotonQuery& query, std::size_t k,
                    NeighbourBuffer& buffer) {
  std::vector<Neighbour> expected = brute_force(map, query);
  EXPECT_EQ(pairs_of(map.within(query, buffer)), pairs_of(expected));
  std::sort(expected.begin(), expected.end());
  expected.resize(std::min(expected.size(), k));
  Pairs nearest = pairs_of(map.nearest(query, k, buffer));
  if (!nearest.empty()) {
    EXPECT_EQ(nearest.back(), *std::max_element(nearest.begin(), nearest.end()));
  }
  std::sort(nearest.begin(), nearest.end());
  EXPECT_EQ(nearest, pairs_of(expected));
  return expected.size();
}

class PhotonMapLayouts : public testing::TestWithParam<int> {};

TEST_P(PhotonMapLayouts, EqualsBruteForce) {
  static constexpr int kCounts[] = {0, 1, 2, 15, 16, 17, 33, 100, 1000, 3001};
  static constexpr std::size_t kNeighbours[] = {0, 1, 5, 50, 100000};
  const auto layout = static_cast<Layout>(GetParam());
  std::size_t found = 0;
  for (const int count : kCounts) {
    const PhotonMap map(random_photons(layout, count, 100 + count));
    ASSERT_EQ(map.size(), static_cast<std::size_t>(count));
    NeighbourBuffer buffer;
    Rng rng = rng_of(200 + count);
    for (int i = 0; i < 200 && !HasFailure(); ++i) {
      const PhotonQuery query = random_query(rng, map);
      found += compare(map, query, kNeighbours[i % 5], buffer);
    }
  }
  EXPECT_GT(found, 1000u);
}
INSTANTIATE_TEST_SUITE_P(All, PhotonMapLayouts, testing::Range(0, static_cast<int>(Layout::count)));

TEST(PhotonMap, EqualsBruteForceAtAllScalesAndFarFromTheOrigin) {
  for (const float scale : {1e-12f, 1e-4f, 1e4f, 1e12f}) {
    for (const float offset : {0.0f, 10.0f}) {
      std::vector<Photon> photons = random_photons(Layout::box_faces, 500, 7);
      for (Photon& p : photons) p.position = (p.position + Vec3{offset, 0, -offset}) * scale;
      const PhotonMap map(photons);
      NeighbourBuffer buffer;
      Rng rng = rng_of(8);
      for (int i = 0; i < 100 && !HasFailure(); ++i) {
        PhotonQuery query = random_query(rng, map);
        query.position = map.position(rng.next() % 500);
        query.max_radius *= scale;
        compare(map, query, 20, buffer);
      }
    }
  }
}

TEST(PhotonMap, EqualsBruteForceInsideRegions) {
  for (const Layout layout : {Layout::plane, Layout::box_faces, Layout::duplicates}) {
    const PhotonMap map(random_photons(layout, 3001, 11));
    NeighbourBuffer buffer;
    Rng rng = rng_of(12);
    std::size_t found = 0;
    for (int i = 0; i < 300 && !HasFailure(); ++i) {
      PhotonQuery query = random_query(rng, map);
      const PhotonRegion region = random_region(rng, query.normal);
      query.region = &region;
      found += compare(map, query, 20, buffer);
    }
    EXPECT_GT(found, 300u);
  }
}

TEST(PhotonMap, KeepsWhatItWasGiven) {
  const std::vector<Photon> photons = random_photons(Layout::volume, 777, 3);
  const PhotonMap map(photons);
  const auto key = [](Vec3 p, std::uint64_t flux, std::uint32_t wi, std::uint32_t rest) {
    return std::tuple(p.x, p.y, p.z, flux, wi, rest);
  };
  std::vector<decltype(key({}, 0, 0, 0))> given, kept;
  for (const Photon& photon : photons) {
    const PhotonPayload a = pack(photon);
    given.push_back(key(photon.position, a.flux, a.wi, a.normal_segments));
  }
  for (std::uint32_t i = 0; i < map.slots(); ++i) {
    if (!map.holds(i)) continue;
    const PhotonPayload& b = map.payload(i);
    kept.push_back(key(map.position(i), b.flux, b.wi, b.normal_segments));
  }
  std::sort(given.begin(), given.end());
  std::sort(kept.begin(), kept.end());
  EXPECT_EQ(given, kept);
}

TEST(PhotonMap, LeavesOutAndCountsWhatIsNotFinite) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Photon> photons = random_photons(Layout::volume, 100, 4);
  photons[3].position.y = nan;
  photons[20].position.x = kInfinity;
  photons[40].wi.z = nan;
  photons[41].normal.z = nan;
  photons[60].flux.g = kInfinity;
  photons[80].flux.b = -1e-30f;
  const PhotonMap map(photons);
  EXPECT_EQ(map.size(), 94u);
  EXPECT_EQ(map.rejected(), 6u);
}

TEST(PhotonMap, SameForEveryNumberOfThreads) {
  std::vector<Photon> photons = random_photons(Layout::box_faces, 60000, 5);
  for (std::size_t i = 0; i < photons.size(); i += 3) photons[i].position.x = 0.5f;
  std::vector<std::tuple<float, float, float, std::uint64_t>> first;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    const PhotonMap map(photons);
    decltype(first) order;
    for (std::uint32_t i = 0; i < map.slots(); ++i) {
      const Vec3 p = map.position(i);
      order.emplace_back(p.x, p.y, p.z, map.payload(i).flux);
    }
    if (threads == 1) first = order;
    EXPECT_EQ(order, first) << threads << " threads";
  }
}

TEST(PhotonMap, TakesAtMost32BytesAPhoton) {
  const PhotonMap map(random_photons(Layout::volume, 50000, 6));
  EXPECT_LE(map.memory(), 32u * map.size());
  EXPECT_GE(map.memory(), 28u * map.size());
}

TEST(PhotonMap, QueryThatIsNotANumberFindsNothing) {
  const PhotonMap map(random_photons(Layout::volume, 100, 9));
  NeighbourBuffer buffer;
  PhotonQuery query;
  query.position = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
  query.normal = {0, 0, 1};
  EXPECT_TRUE(map.nearest(query, 10, buffer).empty());
  EXPECT_TRUE(map.within(query, buffer).empty());
}

}  // namespace
}  // namespace octolux
