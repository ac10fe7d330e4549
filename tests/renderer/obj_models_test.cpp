// tinyobjloader's own awkward models (not part of this repository: skipped, saying so, where
// absent): each loads, or is refused with one clear line.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "core/error.h"
#include "renderer/obj_scene.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;

/// What is refused, and a part of why.
const std::map<std::string, std::string> kRefused{
    {"catmark_torus_creases0.obj", ":93: face index 128 is no vertex normal (the file has 0)"},
    {"invalid-face-definition.obj", "holds no faces"},
    {"invalid-relative-texture-index.obj", ":2: face index -2 is no texture coordinate"},
    {"invalid-relative-vertex-index.obj", ":1: face index -4 is no vertex"},
    {"issue-140-zero-face-idx.obj", ":16: face index 0 is no vertex"},
    {"issue-356-leading-spaces-newmtl.obj", "holds no faces"},
    {"line-prim.obj", "holds no faces"},
    {"points-prim.obj", "holds no faces"},
    {"smoothing-group-two-squares.obj", ":22: face index 5 is no vertex normal (the file has 0)"},
    {"test-nan.obj", ":12: a vertex needs three finite numbers"},
};

void expect_sound(const Scene& scene) {
  EXPECT_FALSE(scene.shapes.empty());
  EXPECT_FALSE(scene.lights.empty());
  for (const Shape& shape : scene.shapes) {
    const auto& mesh = std::get<TriangleMesh>(shape.geometry);
    EXPECT_FALSE(mesh.triangles.empty());
    EXPECT_GT(area(shape), 0);
    for (const Vec3 p : mesh.positions) EXPECT_TRUE(is_finite(p));
    for (const Vec3 n : mesh.normals) EXPECT_NEAR(length(n), 1, 4 * 0x1p-23f);
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t i : t) ASSERT_LT(i, mesh.positions.size());
    }
    ASSERT_LT(static_cast<std::size_t>(shape.bsdf), scene.bsdfs.size());
  }
}

TEST(ObjModels, LoadOrAreRefusedInOneLine) {
  const fs::path folder = fs::path(OCTOLUX_SOURCE_DIR) / "../shared/scenes/tinyobj-models";
  // These models are kept beside the repository, not in it.
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const auto refused = kRefused.find(name);
    Scene scene;
    std::string message;
    try {
      load_obj_scene(entry.path().string(), scene);
    } catch (const Error& error) {
      message = error.what();
    }
    EXPECT_EQ(message.find('\n'), std::string::npos);
    if (refused == kRefused.end()) {
      EXPECT_EQ(message, "");
      expect_sound(scene);
    } else {
      EXPECT_NE(message.find(refused->second), std::string::npos) << message;
    }
  }
}

TEST(ObjModels, CornellBoxesLightUpFromTheirLamps) {
  const fs::path folder = fs::path(OCTOLUX_SOURCE_DIR) / "../shared/scenes/cornellbox-obj";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".obj" || name == "water.obj") continue;
    SCOPED_TRACE(name);
    Scene scene;
    load_obj_scene(entry.path().string(), scene);
    expect_sound(scene);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_TRUE(scene.lights[0]->sample({0, 0.5f, 0}, {0.5f, 0.5f}).has_value());
  }
}

}  // namespace
}  // namespace octolux
