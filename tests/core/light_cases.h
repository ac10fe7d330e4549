// Area lights to test with, each in a scene of its own so that rays tell independently what a point
// sees: every kind of shape, plain and under uneven, turned and mirrored maps.
#pragma once

#include <memory>
#include <string>

#include "accel/ray_caster.h"
#include "core/light.h"
#include "core/rng.h"
#include "core/sampling.h"

namespace octolux::test {

inline Affine affine(std::array<double, 12> rows) {
  Affine a;
  for (int i = 0; i < 12; ++i) a.m[i / 4][i % 4] = rows[i];
  return a;
}

/// The inverse by cofactors.
inline Affine inverse_of(const Affine& a) {
  const auto m = [&a](int i, int j) { return a.m[i % 3][j % 3]; };
  Affine r;
  double determinant = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      r.m[j][i] = m(i + 1, j + 1) * m(i + 2, j + 2) - m(i + 1, j + 2) * m(i + 2, j + 1);
    }
    determinant += m(0, i) * r.m[i][0];
  }
  for (auto& row : r.m) {
    for (int j = 0; j < 3; ++j) row[j] /= determinant;
    row[3] = -(row[0] * a.m[0][3] + row[1] * a.m[1][3] + row[2] * a.m[2][3]);
  }
  return r;
}

inline Vec3 map(const Affine& a, std::array<double, 3> p) {
  std::array<float, 3> r{};
  for (int i = 0; i < 3; ++i) {
    r[i] = static_cast<float>(a.m[i][0] * p[0] + a.m[i][1] * p[1] + a.m[i][2] * p[2] + a.m[i][3]);
  }
  return {r[0], r[1], r[2]};
}

inline Shape quadric(Quadric::Kind kind, const Affine& to_world, bool flip = false) {
  Shape shape;
  shape.geometry = Quadric{kind, to_world, inverse_of(to_world), flip};
  return shape;
}

/// Rectangle |x| <= a, |y| <= b in z = 0, in uneven triangles, facing +z; and a degenerate one.
inline Shape rectangle(float a, float b) {
  TriangleMesh mesh;
  mesh.positions = {{-a, -b, 0}, {a, -b, 0}, {a, b, 0}, {-a, b, 0}, {a / 2, -b, 0}};
  mesh.triangles = {{0, 4, 3}, {0, 4, 1}, {4, 2, 3}, {4, 1, 2}};
  Shape shape;
  shape.geometry = mesh;
  return shape;
}

/// A light, its shape, and rays against it.
class LitShape {
 public:
  LitShape(std::string name_, Shape shape, Vec3 x_, Rgb radiance = {1, 2, 3})
      : name(std::move(name_)),
        x(x_),
        shapes_{std::move(shape)},
        light(make_area_light(shapes_[0], radiance)),
        caster_(shapes_) {
    Rng rng(1, Stream::test, 59, 0);
    for (int i = 0; i < 100; ++i) {
      if (const auto s = light->sample(x, rng.uniform2())) toward = s->at.position;
    }
  }
  LitShape(const LitShape&) = delete;

  /// What is seen along (x, wi), if it is the light's front.
  std::optional<SurfacePoint> seen(Vec3 from, Vec3 wi) const {
    const std::optional<RayHit> hit = caster_.closest({from, wi});
    if (!hit) return std::nullopt;
    const SurfacePoint y = caster_.surface(*hit);
    return is_black(light->radiance(y, -wi)) ? std::nullopt : std::optional(y);
  }
  bool hit(const Ray& ray) const { return caster_.occluded(ray); }
  const Shape& shape() const { return shapes_[0]; }

  std::string name;
  Vec3 x;       // a point that sees the light
  Vec3 toward;  // some point of the light that it sees

 private:
  std::vector<Shape> shapes_;

 public:
  std::unique_ptr<AreaLight> light;

 private:
  RayCaster caster_;
};

inline std::vector<std::unique_ptr<LitShape>> lit_shapes() {
  using enum Quadric::Kind;
  // Turned about an axis, stretched unevenly, sheared; the second is mirrored too.
  const Affine uneven = affine({0.8, -0.5, 0.2, 0.3, 0.6, 1.1, -0.1, -0.2, 0.1, 0.3, 0.4, 0.5});
  const Affine mirrored = affine({-1, 0, 0, 0, 0, 0.5, 0.2, 0, 0, 0, 2, 0});
  const Affine similar = affine({0, -1.5, 0, 1, 1.5, 0, 0, 2, 0, 0, 1.5, 3});
  std::vector<std::unique_ptr<LitShape>> all;
  const auto add = [&all](const char* name, Shape shape, Vec3 x) {
    all.push_back(std::make_unique<LitShape>(name, std::move(shape), x));
  };
  const std::array<double, 3> outside{1.5, -0.8, 0.6}, inside{0.2, 0.3, 0.5}, below{0.2, 0.3, -0.6};
  add("rectangle", rectangle(1, 0.5f), {0.3f, -0.2f, 0.6f});
  add("sphere from outside", quadric(sphere, similar), map(similar, outside));
  add("sphere from inside", quadric(sphere, similar, true), map(similar, inside));
  add("ellipsoid from outside", quadric(sphere, uneven), map(uneven, outside));
  add("ellipsoid from inside", quadric(sphere, mirrored, true), map(mirrored, inside));
  add("disk", quadric(disk, uneven), map(uneven, outside));
  add("flipped disk", quadric(disk, mirrored, true), map(mirrored, below));
  add("cylinder from outside", quadric(cylinder, uneven), map(uneven, outside));
  add("cylinder from inside", quadric(cylinder, mirrored, true), map(mirrored, inside));
  return all;
}

}  // namespace octolux::test
