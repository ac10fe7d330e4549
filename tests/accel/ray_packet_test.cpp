// Packets of rays against single rays: the same hits, lane by lane, for triangles and quadrics.
#include <gtest/gtest.h>

#include "accel/ray_caster.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

Rng rng_of(std::uint64_t index) { return Rng(20060131, Stream::test, 6, index); }

std::vector<Shape> some_shapes(Rng& rng) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Vec3 at = sample_sphere(rng.uniform2());
    for (int corner = 0; corner < 3; ++corner) {
      mesh.positions.push_back(at + sample_sphere(rng.uniform2()) * 0.2f);
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Quadric sphere;
  sphere.to_world = translation(0.5, 0.5, 0) * scaling(0.3, 0.3, 0.3);
  sphere.to_object = *sphere.to_world.inverse();
  Quadric disk;
  disk.kind = Quadric::Kind::disk;
  return {{mesh, -1, -1, ""}, {sphere, -1, -1, ""}, {disk, -1, -1, ""}};
}

RayPacket random_packet(Rng& rng) {
  RayPacket packet;
  for (Ray& ray : packet.rays) {
    ray.origin = sample_sphere(rng.uniform2()) * 1.5f;
    ray.direction = sample_sphere(rng.uniform2());
    if (rng.next() % 3 == 0) ray.t_max = rng.uniform() * 2;
  }
  packet.active = rng.next() & 0xff;
  return packet;
}

TEST(RayPacket, HitsWhatSingleRaysHit) {
  Rng rng = rng_of(1);
  const std::vector<Shape> shapes = some_shapes(rng);
  const RayCaster caster(shapes);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const RayPacket packet = random_packet(rng);
    const auto found = caster.closest_hits(packet);
    for (int lane = 0; lane < RayPacket::kSize; ++lane) {
      const Ray& ray = packet.rays[lane];
      const std::optional<RayHit> expected = caster.closest(ray);
      const bool active = packet.active >> lane & 1;
      ASSERT_EQ(found[lane].hit(), active && expected.has_value());
      if (!found[lane].hit()) continue;
      ++hits;
      EXPECT_EQ(found[lane].shape, expected->shape);
      EXPECT_EQ(found[lane].primitive, expected->primitive);
      EXPECT_NEAR(found[lane].t, expected->t, 1e-5f * expected->t);
      EXPECT_LE(dot(found[lane].normal, ray.direction), 0);
      // Both normals are of the same float vertices; skinny triangles lose some digits.
      EXPECT_NEAR(std::abs(dot(found[lane].normal, caster.surface(*expected).ng)), 1, 1e-4f);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(RayPacket, CornersOfTrianglesOnly) {
  Rng rng = rng_of(2);
  const std::vector<Shape> shapes = some_shapes(rng);
  const RayCaster caster(shapes);
  const auto& mesh = std::get<TriangleMesh>(shapes[0].geometry);
  const auto corners = caster.triangle(0, 7);
  ASSERT_TRUE(corners.has_value());
  EXPECT_TRUE((*corners)[2] == mesh.positions[mesh.triangles[7][2]]);
  EXPECT_FALSE(caster.triangle(0, 300).has_value());
  EXPECT_FALSE(caster.triangle(1, 0).has_value());
  EXPECT_FALSE(caster.triangle(3, 0).has_value());
}

}  // namespace
}  // namespace octolux
