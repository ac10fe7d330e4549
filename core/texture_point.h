// Where a texture is looked up.
#pragma once

#include <cstdint>

#include "core/vec.h"

namespace octolux {

struct TriangleMesh;

/// Texture coordinates, and for textures that read a mesh's attributes the place on that mesh.
struct TexturePoint : Vec2 {
  const TriangleMesh* mesh = nullptr;  // or nullptr: nothing but u and v
  std::uint32_t primitive = 0;
  Vec2 barycentric;  // on that triangle

  TexturePoint() = default;
  TexturePoint(Vec2 uv) : Vec2(uv) {}  // NOLINT: u and v are all most textures want
  TexturePoint(float u, float v) : Vec2{u, v} {}
  TexturePoint(Vec2 uv, const TriangleMesh& mesh_, std::uint32_t primitive_, Vec2 barycentric_)
      : Vec2(uv), mesh(&mesh_), primitive(primitive_), barycentric(barycentric_) {}
};

}  // namespace octolux
