// Meshes of many triangles that emit, to test with.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/constants.h"
#include "core/shape.h"

namespace octolux::test {

/// A ball in 2 n bands of 2 n pairs of triangles, those at the poles without area; facing outwards.
inline Shape ball_mesh(Vec3 center, float radius, int n) {
  TriangleMesh mesh;
  const auto columns = static_cast<std::uint32_t>(2 * n);
  for (int j = 0; j <= 2 * n; ++j) {
    const float theta = kPi * static_cast<float>(j) / static_cast<float>(2 * n);
    const float r = j == 0 || j == 2 * n ? 0 : radius * std::sin(theta);
    for (std::uint32_t i = 0; i < columns; ++i) {
      const float phi = 2 * kPi * static_cast<float>(i) / static_cast<float>(columns);
      mesh.positions.push_back(
          center + Vec3{r * std::cos(phi), r * std::sin(phi), radius * std::cos(theta)});
    }
  }
  for (std::uint32_t j = 0; j < columns; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * columns + i, b = j * columns + (i + 1) % columns;
      mesh.triangles.push_back({a, a + columns, b});
      mesh.triangles.push_back({b, a + columns, b + columns});
    }
  }
  Shape shape;
  shape.geometry = std::move(mesh);
  return shape;
}

}  // namespace octolux::test
