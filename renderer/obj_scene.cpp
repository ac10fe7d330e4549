// Materials, shapes, lights, view, in this order; see obj_scene.h.
#include "renderer/obj_scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "renderer/emitter_facing.h"
#include "renderer/mtl_material.h"
#include "renderer/obj_camera.h"
#include "renderer/obj_mesh.h"

namespace octolux {
namespace {

using MaterialTable = std::map<std::string, MtlMaterial>;

/// Splits at blanks, except where a backslash stands before them.
std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  std::string name;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ' ';
    if (c == '\\' && i + 1 < text.size() && text[i + 1] == ' ') {
      name += text[++i];
    } else if (c != ' ' && c != '\t') {
      name += c == '\\' ? '/' : c;  // paths from Windows
    } else if (!name.empty()) {
      names.push_back(std::exchange(name, {}));
    }
  }
  return names;
}

/// Files that a `mtllib` line names: one whose name may hold blanks, or several.
std::vector<std::string> named_files(const std::string& folder, const std::string& mtllib) {
  const auto in_folder = [&](const std::string& name) {
    return (std::filesystem::path(folder) / name).string();
  };
  std::error_code error;
  if (std::filesystem::is_regular_file(in_folder(mtllib), error)) return {in_folder(mtllib)};
  std::vector<std::string> files;
  for (const std::string& name : split_names(mtllib)) files.push_back(in_folder(name));
  return files;
}

MaterialTable read_materials(const ObjFile& file, Scene& scene) {
  MaterialTable table;
  const std::string folder = std::filesystem::path(file.path).parent_path().string();
  std::map<std::string, bool> seen;
  for (const std::string& mtllib : file.mtllibs) {
    for (const std::string& path : named_files(folder, mtllib)) {
      if (!seen.try_emplace(path, true).second) continue;
      std::error_code error;
      if (!std::filesystem::is_regular_file(path, error)) {
        scene.warnings.push_back(fmt::format("{}: material file not found", path));
        continue;
      }
      MtlFile mtl = read_mtl_file(path);
      scene.hash = hash64(scene.hash ^ mtl.hash);
      for (std::string& w : mtl.warnings) scene.warnings.push_back(std::move(w));
      for (MtlMaterial& m : mtl.materials) table.try_emplace(m.name, std::move(m));
    }
  }
  return table;
}

/// Triangles of the file by material: index 0 is no material, i + 1 is material_names[i].
std::vector<std::vector<std::uint32_t>> group_by_material(const ObjFile& file) {
  std::vector<std::vector<std::uint32_t>> groups(file.material_names.size() + 1);
  for (std::uint32_t t = 0; t < file.triangles.size(); ++t) {
    groups[static_cast<std::size_t>(file.triangles[t].material + 1)].push_back(t);
  }
  return groups;
}

/// Shapes, and beside each what it emits.
class SceneBuilder {
 public:
  SceneBuilder(const ObjFile& file, MaterialTable materials, Scene& scene)
      : file_(file), materials_(std::move(materials)), mesh_builder_(file, {}), scene_(scene) {}

  void build() {
    const auto groups = group_by_material(file_);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (!groups[i].empty()) add_shape(groups[i], i == 0 ? "" : file_.material_names[i - 1]);
    }
    if (scene_.shapes.empty()) {
      throw Error(
          fmt::format("{}: all {} triangles have no area", file_.path, file_.triangles.size()));
    }
    if (degenerate_ > 0) {
      scene_.warnings.push_back(
          fmt::format("{}: {} triangles without area are left out", file_.path, degenerate_));
    }
    add_lights();
  }

 private:
  void add_shape(const std::vector<std::uint32_t>& triangles, const std::string& material) {
    ObjMesh built = mesh_builder_.build(triangles);
    degenerate_ += built.degenerate_triangles;
    if (built.mesh.triangles.empty()) return;
    Shape shape;
    shape.geometry = std::move(built.mesh);
    shape.name = material.empty() ? "(no material)" : material;
    const auto found = materials_.find(material);
    if (found != materials_.end()) {
      shape.bsdf = add_bsdf(found->second, scene_);
      emission_.push_back(emission(found->second, scene_));
    } else {
      shape.bsdf = default_bsdf(material);
      emission_.push_back(Rgb(0));
    }
    scene_.shapes.push_back(std::move(shape));
  }

  int default_bsdf(const std::string& material) {
    scene_.warnings.push_back(
        material.empty()
            ? fmt::format("{}: faces without a material are grey", file_.path)
            : fmt::format("{}: material '{}' is not defined; grey instead", file_.path, material));
    if (default_bsdf_ < 0) default_bsdf_ = add_default_bsdf(scene_);
    return default_bsdf_;
  }

  /// Last, because lights hold on to their shapes.
  void add_lights() {
    Bounds all;
    for (const Shape& shape : scene_.shapes) all.add(bounds(shape));
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      if (is_black(emission_[i].mean())) continue;
      Shape& shape = scene_.shapes[i];
      const std::size_t turned = face_point(std::get<TriangleMesh>(shape.geometry), all.center());
      if (turned > 0) {
        scene_.warnings.push_back(fmt::format(
            "{}: light '{}': {} triangles faced away from the scene and were turned round",
            file_.path, shape.name, turned));
      }
      shape.light = static_cast<int>(scene_.lights.size());
      scene_.lights.push_back(make_area_light(shape, emission_[i]));
    }
    frame_model(all, scene_);
    if (scene_.lights.empty()) add_headlight(all, scene_);
  }

  const ObjFile& file_;
  MaterialTable materials_;
  ObjMeshBuilder mesh_builder_;
  Scene& scene_;
  std::vector<Color> emission_;  // radiance [W m^-2 sr^-1] of each shape
  std::size_t degenerate_ = 0;
  int default_bsdf_ = -1;
};

}  // namespace

void load_obj_scene(const std::string& path, Scene& scene) {
  const ObjFile file = read_obj_file(path);
  scene.hash = file.hash;
  scene.warnings.insert(scene.warnings.end(), file.warnings.begin(), file.warnings.end());
  SceneBuilder(file, read_materials(file, scene), scene).build();
}

}  // namespace octolux
