// OctoBoxes against a slow implementation in double precision: areas by radial quadrature and by
// clipping polygons, boundary photons by leaving each out in turn.
#include <gtest/gtest.h>

#include <algorithm>

#include "estimators/octobox_fit.h"
#include "tests/estimators/lookups.h"
#include "tests/stats.h"

namespace octolux {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Points of several shapes: all over the disc, a strip, a wedge, a few.
PlanePoints make_points(int seed) {
  Rng rng(static_cast<std::uint64_t>(seed), Stream::test, 2, 0);
  PlanePoints points;
  const int count = 1 + static_cast<int>(80 * rng.uniform());
  const float width = std::pow(10.0f, -3 * rng.uniform());
  const float angle = 6.28f * rng.uniform();
  const float offset = rng.uniform() - 0.5f;
  points.resize(count);
  for (int i = 0; i < count;) {
    const Vec2 u = rng.uniform2();
    const Vec2 p{2 * u.x - 1, offset + width * (u.y - 0.5f)};
    const Vec2 q{p.x * std::cos(angle) - p.y * std::sin(angle),
                 p.x * std::sin(angle) + p.y * std::cos(angle)};
    const bool inside = rng.uniform() < 0.7f;
    if (q.x * q.x + q.y * q.y < 1) points.set(i++, q, inside);
  }
  return points;
}

/// Distance to the border of the box along `angle`, at most `radius`.
double reach(const Lanes& box, double angle, double radius) {
  double r = radius;
  for (int j = 0; j < kSides; ++j) {
    const double cosine = std::cos(angle - j * kTurn / 8);
    if (cosine > 1e-12) r = std::min(r, box[j] / cosine);
  }
  return r;
}

double slow_area(const Lanes& box, double radius, double from, double to) {
  constexpr int kSteps = 40000;
  double area = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = reach(box, from + (to - from) * (i + 0.5) / kSteps, radius);
    area += r * r / 2 * (to - from) / kSteps;
  }
  return area;
}

/// The square [-4, 4]^2 cut by the box's half-planes.
double slow_whole_area(const Lanes& box) {
  std::vector<Point2> polygon{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}};
  for (int j = 0; j < kSides; ++j) {
    const Point2 u{std::cos(j * kTurn / 8), std::sin(j * kTurn / 8)};
    const auto beyond = [&](Point2 p) { return p.x * u.x + p.y * u.y - box[j]; };
    std::vector<Point2> cut;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const double da = beyond(a), db = beyond(b);
      if (da <= 0) cut.push_back(a);
      if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
        const double t = da / (da - db);
        cut.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
      }
    }
    polygon = cut;
  }
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

// Quadrature over 40000 steps of a piecewise smooth function of size 1, and angles good to 1e-7.
constexpr double kAreaError = 2e-6;

TEST(OctoBox, CutAreaMatchesQuadrature) {
  for (int seed = 0; seed < 40; ++seed) {
    const Lanes box = octobox_with_origin(make_points(seed));
    for (const float radius : {1.0f, 0.6f, 0.1f}) {
      EXPECT_NEAR(octobox_area(box, radius), slow_area(box, radius, 0, kTurn),
                  kAreaError * radius * radius)
          << "seed " << seed << " radius " << radius;
    }
  }
}

TEST(OctoBox, WholeAreaMatchesClippedPolygon) {
  for (int seed = 0; seed < 40; ++seed) {
    const PlanePoints points = make_points(seed);
    EXPECT_NEAR(octobox_area(octobox(points)), std::max(slow_whole_area(octobox(points)), 0.0),
                1e-6)
        << "seed " << seed;
  }
}

TEST(OctoBox, OctantsOfOneBoxMatchQuadrature) {
  for (int seed = 0; seed < 40; ++seed) {
    const Lanes box = octobox_with_origin(make_points(seed));
    const Lanes areas = octant_areas(split(box), 0.8f);
    for (int i = 0; i < kSides; ++i) {
      EXPECT_NEAR(areas[i], slow_area(box, 0.8, i * kTurn / 8, (i + 1) * kTurn / 8), kAreaError)
          << "seed " << seed << " octant " << i;
    }
  }
}

TEST(OctoBox, BoxesOfOctantsMatchQuadrature) {
  for (int seed = 0; seed < 40; ++seed) {
    const PlanePoints points = make_points(seed);
    const Lanes areas = octant_areas(octant_boxes(points), 1);
    for (int i = 0; i < kSides; ++i) {
      PlanePoints own;
      int count = 0;
      for (int k = 0; k < points.size(); ++k) count += octant(points[k].x, points[k].y) == i;
      own.resize(count);
      count = 0;
      for (int k = 0; k < points.size(); ++k) {
        if (octant(points[k].x, points[k].y) == i) own.set(count++, points[k], true);
      }
      const Lanes box = octobox_with_origin(own);
      EXPECT_NEAR(areas[i], slow_area(box, 1, i * kTurn / 8, (i + 1) * kTurn / 8), kAreaError)
          << "seed " << seed << " octant " << i;
    }
  }
}

TEST(OctoBox, OctantsGoRoundAnticlockwise) {
  for (int i = 0; i < kSides; ++i) {
    const float angle = (static_cast<float>(i) + 0.3f) * static_cast<float>(kTurn) / 8;
    EXPECT_EQ(octant(std::cos(angle), std::sin(angle)), i);
  }
}

TEST(OctoBox, RegularOctagonIsTheKnownShareOfTheDisc) {
  // The paper: the octagon around a disc is 5.5 % larger.
  Lanes box;
  box.fill(1);
  EXPECT_NEAR(octobox_area(box) / std::numbers::pi, 1.0548, 1e-4);
  EXPECT_NEAR(octobox_area(box, 1), std::numbers::pi, 1e-6);
}

TEST(OctoBox, PrincipalAxisIsTheEigenvector) {
  for (int seed = 0; seed < 40; ++seed) {
    const PlanePoints points = make_points(seed);
    if (points.size() < 3) continue;
    double mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
    for (int i = 0; i < points.size(); ++i) mx += points[i].x, my += points[i].y;
    mx /= points.size(), my /= points.size();
    for (int i = 0; i < points.size(); ++i) {
      const double x = points[i].x - mx, y = points[i].y - my;
      xx += x * x, xy += x * y, yy += y * y;
    }
    const double angle = std::atan2(2 * xy, xx - yy) / 2;
    const double gap = std::hypot(2 * xy, xx - yy) / (xx + yy);
    const Vec2 axis = principal_axis(points);
    EXPECT_NEAR(std::abs(axis.x * std::cos(angle) + axis.y * std::sin(angle)), 1, 1e-4 / gap);
    EXPECT_NEAR(axis.x * axis.x + axis.y * axis.y, 1, 1e-6);
  }
}

TEST(OctoBox, CountsThePhotonsWhoseAbsenceLeavesTheBox) {
  for (int seed = 0; seed < 40; ++seed) {
    PlanePoints points = make_points(seed);
    const Fit fit = fit_octobox(points, 0.9f, OctantUse::one);  // turns the points
    const Lanes box = octobox_with_origin(points);
    int expected = 0;
    for (int i = 0; i < points.size(); ++i) {
      PlanePoints others = points;
      others.set(i, {0, 0}, false);
      if (octobox_with_origin(others) == box && points.inside()[i] > 0) ++expected;
    }
    EXPECT_EQ(fit.count, static_cast<float>(expected)) << "seed " << seed;
    EXPECT_EQ(fit.area, octobox_area(box, 0.9f)) << "seed " << seed;
  }
}

TEST(OctoBox, PublishedFormsAreThePapers) {
  for (int seed = 0; seed < 40; ++seed) {
    const PlanePoints points = make_points(seed);
    const double one = published_octobox_area(points, OctantUse::one);
    EXPECT_NEAR(one, std::max(slow_whole_area(octobox(points)), 0.0), 1e-6);
    double eight = 0;
    int fewest = points.size();
    for (int i = 0; i < kSides; ++i) {
      PlanePoints own;
      int count = 0;
      for (int k = 0; k < points.size(); ++k) count += octant(points[k].x, points[k].y) == i;
      fewest = std::min(fewest, count);
      own.resize(count + 1);  // the query as well
      for (int k = 0; k < points.size(); ++k) {
        if (octant(points[k].x, points[k].y) == i) own.set(--count, points[k], true);
      }
      eight += slow_whole_area(octobox(own));
    }
    EXPECT_NEAR(published_octobox_area(points, OctantUse::eight), eight, 4e-6);
    const double share = fewest / 50.0;
    EXPECT_NEAR(published_octobox_area(points, OctantUse::automatic),
                (1 - share) * one + share * eight, 4e-6);
  }
}

TEST(OctoBox, PublishedEstimateIsFluxOverArea) {
  test::Lookup lookup;
  lookup.photons = test::uniform_photons(300, 1, 9);
  EstimatorConfig config;
  config.kernel = "octobox";
  config.correction = false;
  config.octants = "one";
  const Estimate e = lookup(config);
  EXPECT_EQ(e.count, 50);
  EXPECT_NEAR(e.radiance.g * e.area, 50, 50 * 0x1p-17);
}

}  // namespace
}  // namespace octolux
