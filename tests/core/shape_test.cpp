// Triangles and quadrics: where rays meet them, and what their points look like. Quadrics are held
// against closed forms and against bisection in long double.
#include "core/shape.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/frame.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

using Kind = Quadric::Kind;
constexpr Kind kKinds[] = {Kind::sphere, Kind::disk, Kind::cylinder};

Rng rng_of(std::uint64_t index) { return Rng(20060131, Stream::test, 3, index); }

Vec3 random_vector(Rng& rng) { return normalize(sample_sphere(rng.uniform2())); }

Quadric make_quadric(Kind kind, const Affine& to_world, bool flip = false) {
  return {kind, to_world, *to_world.inverse(), flip};
}

/// Rotation, axes scaled by up to 2^4 either way, a place.
Affine random_map(Rng& rng, double scale, double offset) {
  const Vec3 axis = random_vector(rng);
  const Vec3 turn = random_vector(rng);
  const Vec3 place = random_vector(rng);
  double s[3];
  for (double& x : s) x = scale * std::exp2(8 * rng.uniform() - 4);
  return translation(place.x * offset, place.y * offset, place.z * offset) *
         rotation(axis.x, axis.y, axis.z, 77) * scaling(s[0], s[1], s[2]) *
         rotation(turn.x, turn.y, turn.z, 33);
}

/// A point of the unit shape.
Vec3 random_point(Kind kind, Rng& rng) {
  const Vec2 u = rng.uniform2();
  if (kind == Kind::sphere) return normalize(sample_sphere(u));
  const Vec2 d = sample_disk(u);
  if (kind == Kind::disk) return {d.x, d.y, 0};
  return {std::cos(2 * kPi * u.x), std::sin(2 * kPi * u.x), u.y};
}

using Real = long double;
struct Line {
  Real o[3], d[3];
};

Line object_line(const Quadric& q, Vec3 origin, Vec3 direction) {
  Line line{};
  for (int i = 0; i < 3; ++i) {
    line.o[i] = q.to_object.m[i][3];
    for (int j = 0; j < 3; ++j) {
      line.o[i] += static_cast<Real>(q.to_object.m[i][j]) * origin[j];
      line.d[i] += static_cast<Real>(q.to_object.m[i][j]) * direction[j];
    }
  }
  return line;
}

/// The t > 0 at which the line first meets the unit shape, by bisection; -1 for none.
Real first_root(Kind kind, const Line& l) {
  const int axes = kind == Kind::cylinder ? 2 : 3;
  const auto at = [&](int i, Real t) { return l.o[i] + t * l.d[i]; };
  const auto f = [&](Real t) {
    Real sum = -1;
    for (int i = 0; i < axes; ++i) sum += at(i, t) * at(i, t);
    return sum;
  };
  if (kind == Kind::disk) {
    const Real t = -l.o[2] / l.d[2];
    return t > 0 && at(0, t) * at(0, t) + at(1, t) * at(1, t) <= 1 ? t : -1;
  }
  Real middle = 0, dd = 0;
  for (int i = 0; i < axes; ++i) middle -= l.o[i] * l.d[i], dd += l.d[i] * l.d[i];
  middle /= dd;
  if (f(middle) >= 0) return -1;
  for (const Real side : {-1.0L, 1.0L}) {
    Real in = middle, out = middle + side * 3 * std::sqrt(1 / dd);
    for (int i = 0; i < 80; ++i) (f((in + out) / 2) < 0 ? in : out) = (in + out) / 2;
    const bool limits = kind == Kind::sphere || (at(2, in) >= 0 && at(2, in) <= 1);
    if (in > 0 && limits) return in;
  }
  return -1;
}

// Both work on the same float ray, so t may differ by its own rounding and by what double loses:
// 2^-53 times the distance in units of the shape (at most 2^30 here).
TEST(Quadric, MeetsRaysWhereBisectionSays) {
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    Rng rng = rng_of(1000 + i);
    const Kind kind = kKinds[i % 3];
    const double scale = std::exp2(26 * rng.uniform() - 13);
    const Affine map = random_map(rng, scale, 10 * scale);
    const Quadric quadric = make_quadric(kind, map);
    const float distance = static_cast<float>(scale) * std::exp2(16 * rng.uniform() - 3);
    const Vec3 origin = map.point(random_point(kind, rng)) + random_vector(rng) * distance;
    const Vec3 aim = map.point(random_point(kind, rng));
    const Vec3 direction = i % 2 == 0 ? aim - origin : normalize(aim - origin);
    const Real expected = first_root(kind, object_line(quadric, origin, direction));
    const auto hit = intersect(quadric, origin, direction, 0, kInfinity);
    ASSERT_EQ(expected > 0, hit.has_value()) << i;
    if (hit) {
      ++hits;
      ASSERT_NEAR(hit->t / static_cast<double>(expected), 1, 4e-7) << i;
      EXPECT_FALSE(intersect(quadric, origin, direction, 0, hit->t)) << i;
    }
  }
  EXPECT_GT(hits, 9000);
}

TEST(Quadric, SphereFromInsideBehindAndBeside) {
  const Quadric sphere = make_quadric(Kind::sphere, translation(1, 2, 3) * scaling(2, 2, 2));
  const auto t = [&](Vec3 o, Vec3 d) {
    const auto hit = intersect(sphere, o, d, 0, kInfinity);
    return hit ? hit->t : -1;
  };
  EXPECT_FLOAT_EQ(t({1, 2, 3}, {0, 0, 1}), 2);    // from the centre
  EXPECT_FLOAT_EQ(t({1, 2, 13}, {0, 0, -1}), 8);  // from outside
  EXPECT_FLOAT_EQ(t({1, 2, 13}, {0, 0, -4}), 2);  // t in units of the direction
  EXPECT_EQ(t({1, 2, 13}, {0, 0, 1}), -1);        // behind
  EXPECT_EQ(t({3.001f, 2, 13}, {0, 0, -1}), -1);  // beside
  EXPECT_EQ(t({1, 2, 13}, {0, 0, 0}), -1);        // no direction
  const auto far = intersect(sphere, {1, 2, 3e6f}, {0, 0, -1}, 0, kInfinity);
  ASSERT_TRUE(far);
  EXPECT_NEAR(far->position.z, 1, 1e-6);
}

TEST(Quadric, SmallRootSurvivesCancellation) {
  // Starting 1e-9 inside the surface, looking out: t is 1e-9, not 0 and not lost in rounding.
  const Quadric sphere = make_quadric(Kind::sphere, translation(-1, 0, 0));
  const auto hit = intersect(sphere, {-1e-9f, 0, 0}, {1, 0, 0}, 0, kInfinity);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 1e-9, 1e-15);
}

// The normal is perpendicular to mapped tangents, and points away from the axis or centre.
TEST(Quadric, NormalsArePerpendicularToTheSurface) {
  for (int i = 0; i < 3000; ++i) {
    Rng rng = rng_of(50000 + i);
    const Kind kind = kKinds[i % 3];
    const bool flip = i % 2 == 1;
    const Affine map = random_map(rng, 1, 5) * scaling(1, 1, i % 4 < 2 ? 1 : -1);
    const Quadric quadric = make_quadric(kind, map, flip);
    const Vec3 p = random_point(kind, rng);
    const Vec3 radial = kind == Kind::disk       ? Vec3{0, 0, 1}
                        : kind == Kind::cylinder ? Vec3{p.x, p.y, 0}
                                                 : p;
    const Frame frame = Frame::from_normal(normalize(radial));
    const SurfacePoint point = surface_point(quadric, p);
    EXPECT_NEAR(dot(point.ng, normalize(map.vector(frame.s))), 0, 1e-5);
    EXPECT_NEAR(dot(point.ng, normalize(map.vector(frame.t))), 0, 1e-5);
    EXPECT_EQ(dot(point.ng, map.vector(radial)) < 0, flip);
    EXPECT_NEAR(length(point.ng), 1, 4e-7);
    EXPECT_EQ(point.ns, point.ng);
    EXPECT_LE(length(point.position - map.point(p)), point.error);
  }
}

TEST(Quadric, TextureCoordinatesAreMitsubas) {
  const auto uv = [](Kind kind, Vec3 p) { return surface_point(make_quadric(kind, {}), p).uv; };
  const auto expect = [](Vec2 a, Vec2 b) {
    EXPECT_NEAR(a.x, b.x, 1e-6);
    EXPECT_NEAR(a.y, b.y, 1e-6);
  };
  expect(uv(Kind::sphere, {0, 0, 1}), {0, 0});
  expect(uv(Kind::sphere, {0, 1, 0}), {0.25f, 0.5f});
  expect(uv(Kind::sphere, {0, -1, 0}), {0.75f, 0.5f});
  expect(uv(Kind::disk, {-0.5f, 0, 0}), {0.5f, 0.5f});
  expect(uv(Kind::cylinder, {0, 1, 0.3f}), {0.25f, 0.3f});
}

TEST(Quadric, BoundsHoldEveryPointAndAreTight) {
  for (int i = 0; i < 60; ++i) {
    Rng rng = rng_of(70000 + i);
    const Shape shape{make_quadric(kKinds[i % 3], random_map(rng, 1, 4)), -1, -1, ""};
    const auto& quadric = std::get<Quadric>(shape.geometry);
    Bounds seen;
    for (int j = 0; j < 4000; ++j) {
      seen.add(surface_point(quadric, random_point(quadric.kind, rng)).position);
    }
    const Bounds box = bounds(shape);
    EXPECT_EQ(min(box.lower, seen.lower), box.lower);
    EXPECT_EQ(max(box.upper, seen.upper), box.upper);
    // 4000 points leave gaps of about 1/10 of the radius; their caps are 1/100 of it deep.
    EXPECT_LT(length(box.upper - seen.upper), 0.05f * box.radius());
    EXPECT_LT(length(box.lower - seen.lower), 0.05f * box.radius());
  }
}

TEST(Quadric, AreaOfEllipsoidsCylindersAndDisks) {
  const auto area_of = [](Kind kind, const Affine& map) {
    return area(Shape{make_quadric(kind, map), -1, -1, ""});
  };
  const double pi = std::numbers::pi;
  EXPECT_NEAR(area_of(Kind::sphere, scaling(3, 3, 3)) / (36 * pi), 1, 1e-6);
  EXPECT_NEAR(area_of(Kind::disk, rotation(1, 2, 3, 40) * scaling(2, 5, 7)) / (10 * pi), 1, 1e-12);
  EXPECT_NEAR(area_of(Kind::cylinder, scaling(2, 2, 7)) / (28 * pi), 1, 1e-6);
  for (const double c :
       {1.5, 4.0, 50.0, 1000.0}) {  // prolate, and turned so that no axis is special
    const double e = std::sqrt(1 - 1 / (c * c));
    const double prolate = 2 * pi * (1 + c / e * std::asin(e));
    const Affine turned = rotation(1, 2, 3, 40) * scaling(1, 1, c) * rotation(3, 1, 1, 70);
    EXPECT_NEAR(area_of(Kind::sphere, turned) / prolate, 1, 1e-4) << c;
    const double oblate = 2 * pi * (c * c + std::atanh(e) / e);
    const Affine flat = rotation(1, 2, 3, 40) * scaling(c, c, 1) * rotation(3, 1, 1, 70);
    EXPECT_NEAR(area_of(Kind::sphere, flat) / oblate, 1, 1e-4) << c;
  }
}

TriangleMesh one_triangle() {
  TriangleMesh mesh;
  mesh.positions = {{1, 1, 1}, {3, 1, 1}, {1, 4, 1}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(Triangle, PointNormalAndBarycentrics) {
  const SurfacePoint p = surface_point(one_triangle(), 0, 0.25f, 0.5f);
  EXPECT_EQ(p.position, (Vec3{1.5f, 2.5f, 1}));
  EXPECT_EQ(p.ng, (Vec3{0, 0, 1}));
  EXPECT_EQ(p.ns, p.ng);
  EXPECT_EQ(p.uv, (Vec2{0.25f, 0.5f}));
  EXPECT_GT(p.error, 0);
  EXPECT_LT(p.error, 1e-5f);
}

TEST(Triangle, InterpolatesTextureCoordinates) {
  TriangleMesh mesh = one_triangle();
  mesh.uvs = {{0, 0}, {4, 0}, {0, 8}};
  EXPECT_EQ(surface_point(mesh, 0, 0.25f, 0.5f).uv, (Vec2{1, 4}));
}

TEST(Triangle, VertexNormalsDecideTheFrontSide) {
  TriangleMesh mesh = one_triangle();
  mesh.normals = {{0, 0, -1}, {0, 0, -1}, {0.6f, 0, -0.8f}};
  const SurfacePoint p = surface_point(mesh, 0, 0, 0.5f);
  EXPECT_EQ(p.ng, (Vec3{0, 0, -1}));
  EXPECT_LE(length(p.ns - normalize(Vec3{0.3f, 0, -0.9f})), 1e-6f);
}

TEST(Triangle, UselessShadingNormalsFallBack) {
  TriangleMesh mesh = one_triangle();
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {1, 0, -0.5f}};  // below the surface at the third corner
  EXPECT_EQ(surface_point(mesh, 0, 0, 1).ns, (Vec3{0, 0, 1}));
  mesh.normals = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(surface_point(mesh, 0, 0.3f, 0.3f).ns, (Vec3{0, 0, 1}));
}

TEST(Triangle, DegenerateOnesStayFinite) {
  for (const Vec3 third : {Vec3{3, 1, 1}, Vec3{2, 1, 1}, Vec3{1, 1, 1}}) {
    TriangleMesh mesh = one_triangle();
    mesh.positions[2] = third;
    const SurfacePoint p = surface_point(mesh, 0, 0.25f, 0.25f);
    EXPECT_FLOAT_EQ(length(p.ng), 1);
    EXPECT_EQ(p.ns, p.ng);
    EXPECT_TRUE(std::isfinite(p.error));
  }
}

TEST(Triangle, ExtremeScalesKeepTheirNormal) {
  for (const float scale : {1e-20f, 1e-10f, 1e10f, 1e18f}) {
    TriangleMesh mesh = one_triangle();
    for (Vec3& p : mesh.positions) p *= scale;
    EXPECT_EQ(surface_point(mesh, 0, 0.25f, 0.25f).ng, (Vec3{0, 0, 1})) << scale;
  }
}

TEST(Shape, AreaBoundsAndCountOfAMesh) {
  Shape shape{one_triangle(), -1, -1, ""};
  auto& mesh = std::get<TriangleMesh>(shape.geometry);
  mesh.positions.push_back({100, 100, 100});  // belongs to no triangle
  EXPECT_DOUBLE_EQ(area(shape), 3);
  EXPECT_EQ(primitive_count(shape), 1u);
  EXPECT_EQ(bounds(shape).lower, (Vec3{1, 1, 1}));
  EXPECT_EQ(bounds(shape).upper, (Vec3{3, 4, 1}));
  EXPECT_EQ(primitive_count(Shape{make_quadric(Kind::disk, {}), -1, -1, ""}), 1u);
}

}  // namespace
}  // namespace octolux
