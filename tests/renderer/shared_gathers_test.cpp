// renderer/shared_gathers.h: which pixels share what they gathered, and what each makes of it.
#include "renderer/shared_gathers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/bsdf_makers.h"
#include "core/rng.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

constexpr float kSpacing = 0.1f;  // [m] of the pixels
constexpr float kWide = std::numeric_limits<float>::max();

/// A wall seen from the front.
GatheredGrid wall(int size, const std::function<Rgb(int x, int y)>& radiance) {
  GatheredGrid grid{size, size, {}};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      grid.pixels.push_back(
          {.position = {kSpacing * static_cast<float>(x), kSpacing * static_cast<float>(y), 0},
           .normal = {0, 0, 1},
           .reflectance = Rgb(0.5f),
           .radiance = radiance(x, y),
           .segments = 1,
           .diffuse = true});
    }
  }
  return grid;
}

GatherSharing as_far_as(float reach, const GatheredGrid& grid) {
  return GatherSharing(std::vector<SharingLimit>(grid.pixels.size(), {Nearness(1 / reach), {}}));
}

TEST(SharedGathers, ASlopeIsKept) {
  const auto slope = [](int x, int y) {
    return Rgb(1 + 0.1f * static_cast<float>(x) + 0.2f * static_cast<float>(y));
  };
  const GatheredGrid grid = wall(12, slope);
  for (const float reach : {0.15f, 0.3f, kWide}) {
    const GatherSharing sharing = as_far_as(reach, grid);
    const SharedGathers gathers(grid, sharing, 1);
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x) {
        EXPECT_NEAR(gathers.shared(x, y).r, slope(x, y).r, 1e-5) << x << ' ' << y;
      }
    }
  }
}

TEST(SharedGathers, NoiseIsThatOfTheMean) {
  constexpr int kApart = 2 * SharedGathers::kMostPixels + 1, kSize = 10 * kApart;
  Rng rng(1, Stream::test, 0, 0);
  const GatheredGrid grid = wall(kSize, [&](int, int) { return Rgb(rng.uniform()); });
  const GatherSharing sharing = as_far_as(kWide, grid);
  const SharedGathers gathers(grid, sharing, 1);
  Running means;  // of pixels that have no neighbour in common
  for (int y = kApart / 2; y < kSize; y += kApart) {
    for (int x = kApart / 2; x < kSize; x += kApart) means.add(gathers.shared(x, y).r);
  }
  // Uniform numbers have a variance of 1/12, means by Epanechnikov's kernel in the disc of the next
  // radius that share of it. The variance of a hundred is known to sqrt(2 / 99).
  double sum = 0, squares = 0;
  constexpr int kRadius = SharedGathers::kMostPixels + 1;
  for (int j = -kRadius; j <= kRadius; ++j) {
    for (int i = -kRadius; i <= kRadius; ++i) {
      const double w = std::max(0.0, 1 - (i * i + j * j) / static_cast<double>(kRadius * kRadius));
      sum += w;
      squares += w * w;
    }
  }
  EXPECT_NEAR(means.variance() * 12 * sum * sum / squares, 1, 4 * std::sqrt(2.0 / 99));
}

TEST(SharedGathers, NothingIsSharedWherePixelsMiddlesSawNothingToShare) {
  const GatheredGrid grid = wall(7, [](int x, int y) { return Rgb(static_cast<float>(x * y)); });
  const GatherSharing sharing(std::vector<SharingLimit>(grid.pixels.size()));
  const SharedGathers gathers(grid, sharing, 0.9f);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(gathers.shared(i, 4).r, 4.0f * i);
}

struct Other {
  const char* name;
  std::function<void(Gathered&)> make;  // of a pixel next to the middle
  bool counts;
};

class NeighbouringPixel : public testing::TestWithParam<Other> {};

TEST_P(NeighbouringPixel, CountsOnlyIfItKnows) {
  GatheredGrid grid = wall(7, [](int, int) { return Rgb(0); });
  Gathered& other = grid.pixels[3 * 7 + 4];
  other.radiance = Rgb(100);
  GetParam().make(other);
  const GatherSharing sharing = as_far_as(0.25f, grid);
  const float shared = SharedGathers(grid, sharing, 1).shared(3, 3).r;
  EXPECT_EQ(shared > 0, GetParam().counts) << shared;
  EXPECT_EQ(SharedGathers(grid, sharing, 0.3f).shared(3, 3).r, 0);
}

const std::unique_ptr<Bsdf> kCoat = make_plastic({});

const Other kOthers[] = {
    {"Alike", [](Gathered&) {}, true},
    {"ATurnOfTheWall",
     [](Gathered& g) {
       g.normal = normalize(Vec3{0.2f, 0, 1});
     },
     true},
    {"AnotherWall",
     [](Gathered& g) {
       g.normal = {1, 0, 0};
     },
     false},
    {"TheBackOfIt",
     [](Gathered& g) {
       g.normal = {0, 0, -1};
     },
     false},
    {"FarBehind", [](Gathered& g) { g.position.z = -0.3f; }, false},
    {"PastAnEdge", [](Gathered& g) { g.position.z = -0.05f; }, false},
    {"OnACurve", [](Gathered& g) { g.position.z = -0.02f; }, true},
    {"Glossy", [](Gathered& g) { g.diffuse = false; }, false},
    {"UnderACoat", [](Gathered& g) { g.coated = kCoat.get(); }, false},
    {"BehindAPane", [](Gathered& g) { g.segments = 2; }, false},
    {"InAMirror", [](Gathered& g) { g.way.add(false); }, false},
    {"BlackInOneChannel",
     [](Gathered& g) {
       g.reflectance = {0.5f, 0, 0.5f};
     },
     false},
    {"Darker", [](Gathered& g) { g.reflectance = Rgb(0.01f); }, true},
    {"NotFinite", [](Gathered& g) { g.radiance = Rgb(INFINITY); }, false},
};
INSTANTIATE_TEST_SUITE_P(Kinds, NeighbouringPixel, testing::ValuesIn(kOthers),
                         [](const auto& param) { return param.param.name; });

/// What pixel (12, 12) makes of a wall of which one column is bright, and has limits of its own.
float share_of(int bright, Nearness own, Nearness theirs) {
  constexpr int kSize = 25;
  const GatheredGrid grid = wall(kSize, [&](int x, int) { return Rgb(x == bright ? 1.0f : 0.0f); });
  std::vector<SharingLimit> limits(grid.pixels.size(), {own, {}});
  for (int y = 0; y < kSize; ++y)
    limits[static_cast<std::size_t>(y * kSize + bright)] = {theirs, {}};
  return SharedGathers(grid, GatherSharing(limits), 1).shared(12, 12).r;
}

TEST(SharedGathers, FarPixelsCountOnlyIfBothAreFarFromEverything) {
  const Nearness open(0), close(1 / (2 * kSpacing));
  Nearness by_a_wall;  // that bounds the row
  by_a_wall.add(1 / (2 * kSpacing), {0, 1, 0}, 0);
  for (const int near : {13, 15}) {
    EXPECT_GT(share_of(near, open, close), 0) << near;
    EXPECT_GT(share_of(near, by_a_wall, by_a_wall), 0) << near;
    EXPECT_EQ(share_of(near, close, open) > 0, near == 13) << near;
  }
  for (const int far : {16, 20}) {
    EXPECT_GT(share_of(far, open, open), 0) << far;
    EXPECT_EQ(share_of(far, open, close), 0) << far;
    EXPECT_EQ(share_of(far, close, open), 0) << far;
    EXPECT_EQ(share_of(far, by_a_wall, open), 0) << far;
    EXPECT_EQ(share_of(far, open, by_a_wall), 0) << far;
  }
}

/// As shared_gathers.h and gather_sharing.h have it, one neighbour at a time in double precision.
class Brute {
 public:
  Brute(const GatheredGrid& grid, const std::vector<SharingLimit>& limits, float shrink)
      : grid_(grid), limits_(limits), shrink_(shrink) {}

  double shared(int x, int y, int channel) const {
    const Gathered& own = grid_.at(x, y);
    double sum = own.radiance[channel], total = 1;
    if (limit(x, y).way != own.way) return sum;
    for (int j = -SharedGathers::kMostPixels; j <= SharedGathers::kMostPixels; ++j) {
      for (int i = -SharedGathers::kMostPixels; i <= SharedGathers::kMostPixels; ++i) {
        if (i == 0 && j == 0) continue;
        const double w = std::min(weight(x, y, i, j), weight(x, y, -i, -j));
        if (w > 0) sum += w * grid_.at(x + i, y + j).radiance[channel];
        total += w;
      }
    }
    return sum / total;
  }

 private:
  const SharingLimit& limit(int x, int y) const {
    return limits_[static_cast<std::size_t>(y * grid_.width + x)];
  }
  double weight(int x, int y, int i, int j) const {
    const int u = x + i, v = y + j;
    if (u < 0 || v < 0 || u >= grid_.width || v >= grid_.height) return 0;
    const Gathered &a = grid_.at(x, y), &b = grid_.at(u, v);
    if (!b.diffuse || b.way != a.way || b.segments != a.segments || b.coated != a.coated) return 0;
    for (int c = 0; c < 3; ++c) {
      if (a.reflectance[c] > 0 && !(b.reflectance[c] > 0)) return 0;
    }
    const Vec3 d = b.position - a.position;
    const double out = dot(d, a.normal), square = dot(d, d);
    if (dot(a.normal, b.normal) <= 0.95 || out * out > (1 - 0.95 * 0.95) * square) return 0;
    const double across = limit(u, v).way == b.way ? limit(u, v).nearness.most() : kInfinity;
    const bool along = std::max(std::abs(i), std::abs(j)) <= kAlongPixels;
    const double most = std::max<double>(limit(x, y).nearness.most(), across);
    const double near = along ? limit(x, y).nearness.times(d) : most * std::sqrt(square);
    const double pixels = (i * i + j * j) / std::pow(SharedGathers::kMostPixels + 1, 2);
    return std::max(0.0, 1 - std::max(near * near / (shrink_ * shrink_), pixels));
  }

  const GatheredGrid& grid_;
  const std::vector<SharingLimit>& limits_;
  double shrink_;
};

TEST(SharedGathers, EqualBruteForce) {
  Rng rng(2, Stream::test, 0, 0);
  const auto chance = [&](double p) { return rng.uniform() < p; };
  GatheredGrid grid = wall(37, [&](int, int) { return Rgb(rng.uniform(), rng.uniform(), 1); });
  grid.height = 29;
  grid.pixels.resize(37u * 29u);
  std::vector<SharingLimit> limits;
  for (Gathered& g : grid.pixels) {
    g.position.z = chance(0.1) ? -1 : 0.02f * rng.uniform();
    g.normal = normalize(Vec3{0.3f * rng.uniform(), 0.3f * rng.uniform(), 1});
    if (chance(0.05)) g.diffuse = false;
    if (chance(0.05)) g.segments = 2;
    if (chance(0.05)) g.way.add(true);
    if (chance(0.05)) g.coated = kCoat.get();
    if (chance(0.05)) g.reflectance.g = 0;
    Nearness nearness(3 * rng.uniform());
    nearness.add(10 * rng.uniform(), normalize(Vec3{rng.uniform() - 0.5f, rng.uniform(), 0}), 1);
    limits.push_back({nearness, chance(0.95) ? Way() : g.way});
  }
  const GatherSharing sharing(limits);
  for (const float shrink : {1.0f, 0.6f}) {
    const SharedGathers gathers(grid, sharing, shrink);
    const Brute brute(grid, limits, shrink);
    int changed = 0;
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const Gathered& own = grid.at(x, y);
        if (!own.diffuse) continue;
        const Rgb shared = gathers.shared(x, y);
        changed += shared.r != own.radiance.r ? 1 : 0;
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(shared[c], brute.shared(x, y, c), 1e-5) << x << ' ' << y << ' ' << c;
        }
      }
    }
    EXPECT_GT(changed, 37 * 29 / 2);
  }
}

}  // namespace
}  // namespace octolux::test
