// Instances against the same shapes moved and standing in the world themselves.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "accel/ray_caster.h"
#include "core/frame.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

Rng rng_of(std::uint64_t index) { return Rng(20060131, Stream::test, 6, index); }

Vec3 random_direction(Rng& rng) { return normalize(sample_sphere(rng.uniform2())); }

Vec3 random_in_ball(Rng& rng, float radius) {
  const Vec3 direction = random_direction(rng);
  return direction * (radius * rng.uniform());
}

/// Triangles with vertex normals up to 30 degrees off their own, in the group's unit ball.
TriangleMesh random_mesh(Rng& rng, int count) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    std::array<Vec3, 3> p;
    for (Vec3& corner : p) corner = random_in_ball(rng, 1);
    const Vec3 n = normalize(cross(p[1] - p[0], p[2] - p[0]));
    for (const Vec3 corner : p) {
      mesh.positions.push_back(corner);
      mesh.normals.push_back(normalize(n + random_in_ball(rng, 0.5f)));
      mesh.uvs.push_back(rng.uniform2());
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

Instance random_instance(Rng& rng, int group, float distance) {
  const Vec3 axis = random_direction(rng), place = random_in_ball(rng, distance);
  double s[3];
  for (double& x : s) x = std::exp2(1 - 3 * rng.uniform());
  if (rng.next() % 2 == 0) s[1] = -s[1];  // mirrored
  const double angle = 360 * rng.uniform();
  const Affine map = translation(place.x, place.y, place.z) *
                     rotation(axis.x, axis.y, axis.z, angle) * scaling(s[0], s[1], s[2]);
  return {group, map, *map.inverse()};
}

/// A scene with instances of two groups, and the same scene without any.
struct Pair {
  std::vector<Shape> shapes, flat;
  std::vector<Instance> instances;

  explicit Pair(Rng& rng) {
    Quadric sphere{Quadric::Kind::sphere, scaling(0.5, 0.5, 0.8), scaling(2, 2, 1.25)};
    shapes.push_back({random_mesh(rng, 20), 0, -1, "world"});
    shapes.push_back({random_mesh(rng, 20), 0, -1, "mesh", 1});
    shapes.push_back({random_mesh(rng, 5), 0, -1, "other", 0});
    shapes.push_back({sphere, 0, -1, "sphere", 1});
    for (int i = 0; i < 8; ++i) instances.push_back(random_instance(rng, i % 3 == 0 ? 0 : 1, 3));
    const RayCaster caster(shapes, instances);
    flat.push_back(shapes[0]);
    for (const PlacedShape& p : caster.placed()) {
      flat.push_back(moved(shapes[p.shape], instances[p.instance].to_world));
      flat.back().group = -1;
    }
  }
  /// Number in the flat scene of a number in the other.
  std::uint32_t flat_number(std::uint32_t number) const {
    return number < shapes.size() ? number : number - static_cast<std::uint32_t>(shapes.size()) + 1;
  }
};

/// Float errors of coordinates up to 8 under maps that stretch by up to 8.
constexpr float kTolerance = 8 * 8 * 16 * 0x1p-24f;

void expect_same(const SurfacePoint& a, const SurfacePoint& b) {
  EXPECT_LE(length(a.position - b.position), kTolerance);
  EXPECT_LE(length(a.ng - b.ng), 1e-4f);  // thin triangles turn easily
  EXPECT_LE(length(a.ns - b.ns), 1e-4f);
  EXPECT_LE(length(Vec3{a.uv.x - b.uv.x, a.uv.y - b.uv.y, 0}), 1e-3f);
  EXPECT_EQ(a.primitive, b.primitive);
}

TEST(Instances, AreWhereTheirShapesWouldBe) {
  Rng rng = rng_of(1);
  int hits = 0, differences = 0;
  for (int scene = 0; scene < 20; ++scene) {
    const Pair pair(rng);
    const RayCaster instanced(pair.shapes, pair.instances), flat(pair.flat);
    for (int i = 0; i < 2000; ++i) {
      const Ray ray{random_in_ball(rng, 6), random_direction(rng)};
      const auto a = instanced.closest(ray), b = flat.closest(ray);
      ASSERT_EQ(instanced.occluded(ray), a.has_value());
      // At the very edge of a triangle either may miss.
      if (a.has_value() != b.has_value() || (a && pair.flat_number(a->shape) != b->shape)) {
        ++differences;
        continue;
      }
      if (!a || std::abs(a->t - b->t) > kTolerance) {
        differences += a ? 1 : 0;
        continue;
      }
      ++hits;
      expect_same(instanced.surface(*a), flat.surface(*b));
    }
  }
  EXPECT_GT(hits, 5000);
  // 1e-6 of a triangle's size, at some 100 edges about a hit: 1e-4 of the rays.
  EXPECT_LE(differences, 20);
}

TEST(Instances, PacketsSeeThemToo) {
  Rng rng = rng_of(2);
  const Pair pair(rng);
  const RayCaster caster(pair.shapes, pair.instances);
  for (int i = 0; i < 500; ++i) {
    RayPacket packet;
    packet.active = 0xff;
    for (Ray& ray : packet.rays) ray = {random_in_ball(rng, 6), random_direction(rng)};
    const auto hits = caster.closest_hits(packet);
    for (int k = 0; k < RayPacket::kSize; ++k) {
      const auto single = caster.closest(packet.rays[k]);
      ASSERT_EQ(single.has_value(), hits[k].hit());
      if (!single) continue;
      EXPECT_EQ(single->shape, hits[k].shape);
      EXPECT_EQ(single->primitive, hits[k].primitive);
      const Vec3 ng = caster.surface(*single).ng;
      EXPECT_NEAR(std::abs(dot(ng, hits[k].normal)), 1, 1e-5f);
      EXPECT_LE(dot(hits[k].normal, packet.rays[k].direction), 0);
    }
  }
}

TEST(Instances, TrianglesAreInTheWorld) {
  Rng rng = rng_of(3);
  const Pair pair(rng);
  const RayCaster instanced(pair.shapes, pair.instances), flat(pair.flat);
  int triangles = 0;
  const auto last = static_cast<std::uint32_t>(pair.shapes.size() + instanced.placed().size());
  for (std::uint32_t number = 4; number < last; ++number) {
    for (std::uint32_t primitive = 0; primitive < 25; ++primitive) {
      const auto a = instanced.triangle(number, primitive);
      const auto b = flat.triangle(pair.flat_number(number), primitive);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      ++triangles;
      for (const Vec3 corner : *a) {
        EXPECT_TRUE(corner == (*b)[0] || corner == (*b)[1] || corner == (*b)[2]);
      }
    }
  }
  EXPECT_GT(triangles, 100);
  EXPECT_FALSE(instanced.triangle(last, 0));
}

/// What visit_near shows, by number and primitive; how far it looks does not change.
std::map<std::uint64_t, NearPrimitive> near(const RayCaster& caster, Vec3 p, float radius) {
  struct Shown {
    float radius;
    std::map<std::uint64_t, NearPrimitive> all;
  } shown{radius, {}};
  const auto note = [](void* to, const NearPrimitive& primitive) {
    static_cast<Shown*>(to)->all[primitive.id] = primitive;
    return static_cast<Shown*>(to)->radius;
  };
  caster.visit_near(p, radius, note, &shown);
  return shown.all;
}

/// Does one of many points of it come nearer to p than `radius`?
bool reaches(const NearPrimitive& near, Vec3 p, float radius) {
  if (!near.triangle) return false;  // bounds are those of the group's space
  constexpr int kSteps = 16;
  const auto& [a, b, c] = near.corners;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; i + k <= kSteps; ++k) {
      const float u = static_cast<float>(i) / kSteps, v = static_cast<float>(k) / kSteps;
      if (length(a + (b - a) * u + (c - a) * v - p) < radius - kTolerance) return true;
    }
  }
  return false;
}

TEST(Instances, AreNearPointsToo) {
  Rng rng = rng_of(5);
  const Pair pair(rng);
  const RayCaster instanced(pair.shapes, pair.instances), flat(pair.flat);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_in_ball(rng, 5);
    const float radius = 0.8f * rng.uniform();
    std::set<std::uint64_t> numbers;
    for (const auto& [id, primitive] : near(instanced, p, radius)) {
      const auto number = static_cast<std::uint32_t>(id >> 32);
      numbers.insert(std::uint64_t{pair.flat_number(number)} << 32 | (id & 0xffffffff));
    }
    for (const auto& [id, primitive] : near(flat, p, radius)) {
      if (!reaches(primitive, p, radius)) continue;
      ++found;
      EXPECT_TRUE(numbers.count(id));
    }
  }
  EXPECT_GT(found, 300);
}

// As SpawnedRays.NeverHitTheirOwnPlane, but the plane stands in a group.
TEST(Instances, RaysLeaveTheirTriangles) {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    for (int i = 0; i < 300; ++i) {
      Rng rng = rng_of(1000 + i);
      TriangleMesh mesh;
      for (int k = 0; k < 3; ++k) mesh.positions.push_back(random_direction(rng) * scale);
      mesh.triangles = {{0, 1, 2}};
      const std::vector<Shape> shapes{{mesh, 0, -1, "", 0}};
      const std::vector<Instance> instances{random_instance(rng, 0, i % 3 == 0 ? 1e3f : scale)};
      const RayCaster caster(shapes, instances);
      for (int j = 0; j < 200; ++j) {
        const Vec2 b = sample_triangle(rng.uniform2());
        const SurfacePoint p = place(surface_point(mesh, 0, b.x, b.y), instances[0]);
        const float cosine = std::exp2(-14 * rng.uniform()) * (j % 2 == 0 ? 1.0f : -1.0f);
        const float sine = std::sqrt(1 - cosine * cosine);
        const Frame frame = Frame::from_normal(p.ng);
        const Vec3 out = normalize(frame.to_world({sine, 0, cosine}));
        ASSERT_FALSE(caster.occluded({offset_origin(p.position, p.ng, p.error, out), out})) << i;
      }
    }
  }
}

TEST(Instances, BoundsHoldAllOfThem) {
  Rng rng = rng_of(4);
  const Pair pair(rng);
  const RayCaster instanced(pair.shapes, pair.instances), flat(pair.flat);
  const Bounds outer = instanced.bounds(), inner = flat.bounds();
  EXPECT_EQ(min(outer.lower, inner.lower), outer.lower);
  EXPECT_EQ(max(outer.upper, inner.upper), outer.upper);
  EXPECT_LE(outer.radius(), 2 * inner.radius());  // corners of boxes: at most sqrt(3) as far
}

}  // namespace
}  // namespace octolux
