// A texture that reads what a mesh carries at its vertices or faces. The mesh is that of the point
// looked up, so one texture serves all meshes that have the attribute.
#include "core/shape.h"
#include "core/texture.h"

namespace octolux {
namespace {

class MeshAttributeTexture final : public Texture {
 public:
  explicit MeshAttributeTexture(std::string name) : name_(std::move(name)) {}

  Rgb eval(const TexturePoint& at) const override {
    if (!at.mesh) return mean();
    for (const MeshAttribute& a : at.mesh->attributes) {
      if (a.name == name_) return value(a, at);
    }
    return mean();
  }

  /// Unknown: it differs from mesh to mesh.
  Rgb mean() const override { return Rgb(0.5f); }

 private:
  static Rgb value(const MeshAttribute& attribute, const TexturePoint& at) {
    if (attribute.per_face) return attribute.values[at.primitive];
    const auto& corner = at.mesh->triangles[at.primitive];
    const auto [u, v] = at.barycentric;
    return attribute.values[corner[0]] * (1 - u - v) + attribute.values[corner[1]] * u +
           attribute.values[corner[2]] * v;
  }

  std::string name_;
};

}  // namespace

std::unique_ptr<Texture> make_mesh_attribute_texture(const std::string& name) {
  return std::make_unique<MeshAttributeTexture>(name);
}

}  // namespace octolux
