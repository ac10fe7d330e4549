// The convex hull, and the kernel that is the oracle of OctoBoxes.
#include <gtest/gtest.h>

#include <algorithm>

#include "estimators/convex_hull.h"
#include "tests/estimators/lookups.h"
#include "tests/stats.h"

namespace octolux {
namespace {

double side(Point2 a, Point2 b, Point2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

TEST(ConvexHull, HoldsAllPointsAndTurnsLeft) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Rng rng(seed, Stream::test, 3, 0);
    std::vector<Point2> points;
    for (int i = 0; i < 40; ++i) {
      const Vec2 u = rng.uniform2();
      points.push_back({u.x, u.y});
      if (i % 5 == 0) points.push_back({u.x, u.y});
    }
    const std::vector<Point2> all = points;
    const std::vector<Point2> hull = convex_hull(points);
    ASSERT_GE(hull.size(), 3u);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Point2 a = hull[i], b = hull[(i + 1) % hull.size()];
      EXPECT_GT(side(a, b, hull[(i + 2) % hull.size()]), 0);
      for (const Point2 p : all) EXPECT_GE(side(a, b, p), -1e-15);
    }
  }
}

TEST(ConvexHull, LinesAndPointsHaveNoArea) {
  for (const std::vector<Point2>& set : {std::vector<Point2>{},
                                         {{1, 2}},
                                         {{1, 2}, {1, 2}, {1, 2}},
                                         {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {1, 1}}}) {
    std::vector<Point2> points = set;
    EXPECT_EQ(polygon_area(convex_hull(points), kInfinity), 0);
  }
}

TEST(ConvexHull, PolygonInDisc) {
  const std::vector<Point2> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const double pi = std::numbers::pi;
  EXPECT_NEAR(polygon_area(square, kInfinity), 4, 1e-14);
  EXPECT_NEAR(polygon_area(square, 0.5), pi / 4, 1e-14);
  EXPECT_NEAR(polygon_area(square, 2), 4, 1e-14);
  // Four circular segments beyond the sides.
  const double r = 1.2, segment = r * r * std::acos(1 / r) - std::sqrt(r * r - 1);
  EXPECT_NEAR(polygon_area(square, r), pi * r * r - 4 * segment, 1e-13);
  const std::vector<Point2> half_plane{{0.3, -9}, {9, -9}, {9, 9}, {0.3, 9}};
  EXPECT_NEAR(polygon_area(half_plane, 1), std::acos(0.3) - 0.3 * std::sqrt(1 - 0.09), 1e-13);
}

TEST(Hull, PublishedIsFluxOverHull) {
  test::Lookup lookup;
  lookup.photons = {test::photon_at({1, 0, 0}),       test::photon_at({0, 1, 0}),
                    test::photon_at({-1, 0, 0}),      test::photon_at({0, -1, 0}),
                    test::photon_at({0.1f, 0.2f, 0}), test::photon_at({5, 5, 0})};
  EstimatorConfig config;
  config.kernel = "hull";
  config.correction = false;
  config.neighbours = 5;
  EXPECT_NEAR(lookup(config).radiance.g, 5.0 / 2.0, 1e-5);
  EXPECT_NEAR(lookup(config).area, 2, 1e-5);
}

/// The theorem the corrected forms stand on (octobox_fit.h): no bias in any convex region.
TEST(Hull, CorrectedIsUnbiasedInConvexRegions) {
  LabSettings settings;
  settings.kernels = {parse_lab_kernel("hull")};
  settings.neighbours = {30, 50, 200};
  settings.runs = 2000;
  const std::vector<std::pair<const char*, double>> places{
      {"wall", 0}, {"corner", 0}, {"strip", 0.3}, {"strip", 0.05}, {"wedge", 45}, {"wedge", 150}};
  for (const auto& [name, size] : places) {
    const LabCase& chosen = find_lab_case(name);
    for (const LabResult& r : measure(chosen.layout(chosen.distance, size), settings)) {
      EXPECT_GT(test::z_test_p(r.bias() / r.standard_error),
                test::sidak(test::kAlpha, 3.0 * static_cast<double>(places.size())))
          << name << " " << size << " n " << r.neighbours << ": " << r.bias();
    }
  }
}

}  // namespace
}  // namespace octolux
