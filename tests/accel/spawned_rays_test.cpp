// Rays that start on surfaces: they must not hit the surface they leave, must not jump over thin
// walls, and must reach each other; at all scales, far from the origin, at grazing angles.
#include <gtest/gtest.h>

#include "accel/ray_caster.h"
#include "core/frame.h"
#include "core/ray.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

Rng rng_of(std::uint64_t index) { return Rng(20060131, Stream::test, 5, index); }

Vec3 random_direction(Rng& rng) { return normalize(sample_sphere(rng.uniform2())); }

/// A parallelogram of two triangles.
Shape parallelogram(Vec3 corner, Vec3 a, Vec3 b) {
  TriangleMesh mesh;
  mesh.positions = {corner, corner + a, corner + a + b, corner + b};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {mesh, -1, -1, ""};
}

Shape triangle(Vec3 p, Vec3 q, Vec3 r) {
  TriangleMesh mesh;
  mesh.positions = {p, q, r};
  mesh.triangles = {{0, 1, 2}};
  return {mesh, -1, -1, ""};
}

SurfacePoint random_point(const Shape& shape, Rng& rng) {
  const auto& mesh = std::get<TriangleMesh>(shape.geometry);
  const std::uint32_t primitive = rng.next() % static_cast<std::uint32_t>(mesh.triangles.size());
  const Vec2 b = sample_triangle(rng.uniform2());
  return surface_point(mesh, primitive, b.x, b.y);
}

/// Away from the plane, its cosine uniform on a log scale down to 2^-14, on either side.
Vec3 grazing_direction(Vec3 ng, Rng& rng) {
  const float cosine = std::exp2(-14 * rng.uniform());
  const float phi = 2 * kPi * rng.uniform();
  const bool below = rng.next() % 2 == 0;
  const float sine = std::sqrt(1 - cosine * cosine);
  const Frame frame = Frame::from_normal(ng);
  return normalize(
      frame.to_world({sine * std::cos(phi), sine * std::sin(phi), below ? -cosine : cosine}));
}

/// Number of rays of `count` that leave `shape` and hit it.
int count_rehits(const Shape& shape, int count, Rng& rng) {
  const std::vector<Shape> shapes{shape};
  const RayCaster caster(shapes);
  int rehits = 0;
  for (int i = 0; i < count; ++i) {
    const SurfacePoint p = random_point(shape, rng);
    const Vec3 direction = grazing_direction(p.ng, rng);
    const Ray ray{offset_origin(p.position, p.ng, p.error, direction), direction};
    rehits += caster.occluded(ray) ? 1 : 0;
  }
  return rehits;
}

class SpawnedRays : public testing::TestWithParam<float> {};  // the scene's scale

TEST_P(SpawnedRays, NeverHitTheirOwnPlane) {
  const float scale = GetParam();
  for (int i = 0; i < 400; ++i) {
    Rng rng = rng_of(1000 + i);
    const Frame frame = i % 5 == 0 ? Frame{} : Frame::from_normal(random_direction(rng));
    const Vec3 corner = random_direction(rng) * (i % 2 == 0 ? scale : 100 * scale);
    const float aspect = std::exp2(-6 * rng.uniform());
    const float skew = 2 * rng.uniform() - 1;
    const Shape shape =
        parallelogram(corner, frame.s * scale, (frame.t * aspect + frame.s * skew) * scale);
    EXPECT_EQ(count_rehits(shape, 300, rng), 0) << i;
  }
}

// Far away the corners of a quadrilateral are rounded off a common plane, so triangles.
TEST_P(SpawnedRays, NeverHitTheirOwnTriangleFarFromTheOrigin) {
  const float scale = GetParam();
  for (int i = 0; i < 400; ++i) {
    Rng rng = rng_of(2000 + i);
    const Vec3 corner{1e5f, -3e4f, 7e4f};
    const Vec3 a = random_direction(rng) * scale;
    const Vec3 b = random_direction(rng) * scale;
    EXPECT_EQ(count_rehits(triangle(corner, corner + a, corner + b), 300, rng), 0) << i;
  }
}

TEST_P(SpawnedRays, SliversHitThemselvesHardlyEver) {
  const float scale = GetParam();
  int rehits = 0;
  for (int i = 0; i < 200; ++i) {
    Rng rng = rng_of(3000 + i);
    const Frame frame = Frame::from_normal(random_direction(rng));
    const float height = scale * std::exp2(-12.0f * rng.uniform());
    const Shape shape =
        triangle({0, 0, 0}, frame.s * scale, frame.s * (scale * rng.uniform()) + frame.t * height);
    rehits += count_rehits(shape, 500, rng);
  }
  EXPECT_LE(rehits, 10);  // of 100 000; 2 % without the term for slivers
}

TEST_P(SpawnedRays, DoNotJumpThinWalls) {
  const float scale = GetParam();
  for (const float offset : {0.0f, 1e5f}) {
    const float thickness = 1e-4f * scale;
    if (thickness < 64 * 0x1p-23f * offset) continue;  // float cannot hold such a wall
    for (int i = 0; i < 100; ++i) {
      Rng rng = rng_of(4000 + i);
      const Frame frame = Frame::from_normal(random_direction(rng));
      const Vec3 corner = random_direction(rng) * scale + Vec3{offset, offset, -offset};
      const std::vector<Shape> wall{
          parallelogram(corner, frame.s * scale, frame.t * scale),
          parallelogram(corner + frame.n * thickness, frame.s * scale, frame.t * scale)};
      const RayCaster caster(wall);
      for (int j = 0; j < 100; ++j) {
        const SurfacePoint p = random_point(wall[j % 2], rng);
        const Vec3 into = frame.n * (j % 2 == 0 ? 1.0f : -1.0f);
        const auto hit = caster.closest({offset_origin(p.position, p.ng, p.error, into), into});
        ASSERT_TRUE(hit) << i;
        EXPECT_EQ(hit->shape, j % 2 == 0 ? 1u : 0u);
        EXPECT_NEAR(hit->t / thickness, 1, 0.5);
      }
    }
  }
}

// Two surfaces that see each other, near or a thousand times as far apart as they are large, with
// the origin of coordinates near either of them.
TEST_P(SpawnedRays, ConnectingRaysAreFree) {
  const float scale = GetParam();
  for (int i = 0; i < 300; ++i) {
    Rng rng = rng_of(5000 + i);
    const Frame frame = Frame::from_normal(random_direction(rng));
    const float distance = scale * std::exp2(10 * rng.uniform());
    const Vec3 place = i % 3 == 0 ? Vec3{} : frame.n * (i % 3 == 1 ? -distance : -distance / 2);
    const std::vector<Shape> shapes{
        parallelogram(place, frame.s * scale, frame.t * scale),
        parallelogram(place + frame.n * distance, frame.t * scale, frame.s * scale)};
    const RayCaster caster(shapes);
    for (int j = 0; j < 200; ++j) {
      const SurfacePoint a = random_point(shapes[j % 2], rng);
      const SurfacePoint b = random_point(shapes[1 - j % 2], rng);
      const Ray ray = connecting_ray({a.position, a.ng, a.error}, {b.position, b.ng, b.error});
      ASSERT_FALSE(caster.occluded(ray)) << i << " " << j;
    }
  }
}

TEST_P(SpawnedRays, LeaveQuadrics) {
  const float scale = GetParam();
  for (int i = 0; i < 300; ++i) {
    Rng rng = rng_of(6000 + i);
    const Vec3 place = random_direction(rng) * (i % 2 == 0 ? scale : 1e3f * scale);
    const Affine map = translation(place.x, place.y, place.z) * scaling(scale, scale, scale);
    const std::vector<Shape> shapes{
        {Quadric{Quadric::Kind::sphere, map, *map.inverse()}, -1, -1, ""}};
    const RayCaster caster(shapes);
    for (int j = 0; j < 200; ++j) {
      const Vec3 inward = random_direction(rng);
      const auto hit = caster.closest({place - inward * (scale * 3), inward});
      ASSERT_TRUE(hit);
      const SurfacePoint p = caster.surface(*hit);
      const Vec3 out = grazing_direction(p.ng, rng);
      const Ray ray{offset_origin(p.position, p.ng, p.error, out), out};
      const auto next = caster.closest(ray);
      // A sphere is left for good outwards; inwards the chord is 2 r cos long.
      const float cosine = dot(out, p.ng);
      ASSERT_EQ(next.has_value(), cosine < 0);
      if (cosine > -0.1f) continue;
      EXPECT_NEAR(next->t, -2 * cosine * scale, 4 * p.error / -cosine);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, SpawnedRays, testing::Values(1e-4f, 1.0f, 1e4f));

}  // namespace
}  // namespace octolux
