// Mitsuba's own regression scenes (not part of this repository: skipped, saying so, where absent),
// held by Mitsuba's own rule: a z-test per pixel against the reference with the variance that comes
// with it, Sidak's correction at 0.01, 99.75 % of the pixels. The rule works in XYZ, because the
// variances were measured there and only stored as RGB.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/image_io.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

const std::string kRoot =
    std::string(OCTOLUX_SOURCE_DIR) + "/../shared/scenes/mitsuba-data/tests/scenes/";

/// Linear Rec.709 to XYZ (ITU-R BT.709-6), linear, so that it undoes what was done to variances.
Rgb to_xyz(Rgb c) {
  return {0.412453f * c.r + 0.357580f * c.g + 0.180423f * c.b,
          0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b,
          0.019334f * c.r + 0.119193f * c.g + 0.950227f * c.b};
}

struct Case {
  const char* scene;
  const char* reference;  // without _rgb.exr
  int effort = 1;         // samples rendered for each one the rule counts
};

class MitsubaDataSlow : public testing::TestWithParam<Case> {};

TEST_P(MitsubaDataSlow, PathPassesItsAcceptanceRule) {
  const Case& c = GetParam();
  if (!std::filesystem::exists(kRoot))
    GTEST_SKIP() << "no mitsuba-data scenes beside the repository";
  const auto scene = load_scene(kRoot + c.scene, {});
  const Image reference = read_exr(kRoot + c.reference + "_rgb.exr").image();
  const Image variance = read_exr(kRoot + c.reference + "_rgb_var.exr").image();
  ASSERT_EQ(reference.width, scene->film.crop_width);
  const auto pixels = static_cast<int>(reference.pixels.size());
  const int samples = 2'000'000 / pixels;
  const Image image = render_film(*scene, path_config(samples * GetParam().effort)).radiance();

  const double limit = sidak(0.01, pixels);
  int passed = 0;
  for (int i = 0; i < pixels; ++i) {
    const Rgb difference = to_xyz(image.pixels[i] - reference.pixels[i]);
    const Rgb spread = to_xyz(variance.pixels[i]);
    for (int ch = 0; ch < 3; ++ch) {
      const double var = std::max(1e-4f, spread[ch]);
      const double z = difference[ch] * std::sqrt(samples / var);
      passed += z_test_p(z) > limit;
    }
  }
  std::printf("  %s: %.4f of the pixels pass (0.9975 needed)\n", c.scene, passed / (3.0 * pixels));
  EXPECT_GE(passed / (3.0 * pixels), 0.9975);
}

/// Photon mapping by the same rule, where it has photons to map: a pass counts as a sample, and the
/// passes' own variance is added to the reference's, for what photons have in common.
TEST_P(MitsubaDataSlow, PhotonPassesItToo) {
  const Case& c = GetParam();
  if (!std::filesystem::exists(kRoot))
    GTEST_SKIP() << "no mitsuba-data scenes beside the repository";
  const auto scene = load_scene(kRoot + c.scene, {});
  const bool gathers = std::any_of(scene->bsdfs.begin(), scene->bsdfs.end(),
                                   [](const auto& b) { return b->has(Lobes::smooth); });
  if (!gathers) GTEST_SKIP() << "no diffuse or rough surface";
  const Image reference = read_exr(kRoot + c.reference + "_rgb.exr").image();
  const Image variance = read_exr(kRoot + c.reference + "_rgb_var.exr").image();
  constexpr int kPasses = 48;
  const Film film = render_film(*scene, photon_config(kPasses, 20'000));
  const Image image = film.radiance(), own = film.variance();
  const auto pixels = static_cast<int>(reference.pixels.size());
  const double limit = sidak(0.01, pixels);
  int passed = 0;
  for (int i = 0; i < pixels; ++i) {
    const Rgb difference = to_xyz(image.pixels[i] - reference.pixels[i]);
    const Rgb theirs = to_xyz(variance.pixels[i]), ours = to_xyz(own.pixels[i]);
    for (int ch = 0; ch < 3; ++ch) {
      const double var = static_cast<double>(std::max(1e-4f, theirs[ch]) / kPasses + ours[ch]);
      passed += z_test_p(static_cast<double>(difference[ch]) / std::sqrt(var)) > limit;
    }
  }
  std::printf("  %s: photon, %.4f of the pixels pass\n", c.scene, passed / (3.0 * pixels));
  EXPECT_GE(passed / (3.0 * pixels), 0.9975);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, MitsubaDataSlow,
    testing::Values(
        Case{"bsdf_spheres/test_arealight_path.xml", "bsdf_spheres/refs/test_arealight_ref"},
        Case{"bsdf_spheres/test_constant_path.xml", "bsdf_spheres/refs/test_constant_ref"},
        Case{"bsdf_spheres/test_pointlight_path.xml", "bsdf_spheres/refs/test_pointlight_ref"},
        Case{"bsdf_spheres/test_envmap_path.xml", "bsdf_spheres/refs/test_envmap_ref"},
        Case{"bsdf_spheres/test_roughdielectric_path.xml",
             "bsdf_spheres/refs/test_roughdielectric_ref"},
        Case{"bsdf_spheres/test_roughplastic_linear_path.xml",
             "bsdf_spheres/refs/test_roughplastic_linear_ref"},
        Case{"bsdf_spheres/test_roughplastic_nonlinear_path.xml",
             "bsdf_spheres/refs/test_roughplastic_nonlinear_ref"},
        Case{"bsdf_spheres/test_textured_diffuse_path.xml",
             "bsdf_spheres/refs/test_textured_diffuse_ref"},
        Case{"bsdf_spheres/test_textured_roughconductor_path.xml",
             "bsdf_spheres/refs/test_textured_roughconductor_ref"},
        Case{"bsdf_spheres/test_normalmap_path.xml", "bsdf_spheres/refs/test_normalmap_ref"},
        Case{"bsdf_spheres/test_normalmap_roughconductor_path.xml",
             "bsdf_spheres/refs/test_normalmap_roughconductor_ref"},
        Case{"bsdf_spheres/test_normalmap_identity_roughconductor_path.xml",
             "bsdf_spheres/refs/test_normalmap_identity_roughconductor_ref"},
        Case{"bsdf_spheres/test_bumpmap_path.xml", "bsdf_spheres/refs/test_bumpmap_ref"},
        Case{"bsdf_spheres/test_texturedprincipled1_path.xml",
             "bsdf_spheres/refs/test_texturedprincipled1_ref"},
        Case{"bsdf_spheres/test_texturedprincipled2_path.xml",
             "bsdf_spheres/refs/test_texturedprincipled2_ref"},
        Case{"bsdf_spheres/test_texturedprincipledthin_path.xml",
             "bsdf_spheres/refs/test_texturedprincipledthin_ref"},
        Case{"orthographic_sensor/test_orthographic_path.xml",
             "orthographic_sensor/refs/test_orthographic_ref"},
        Case{"floating_sphere/test_directional_direct.xml",
             "floating_sphere/refs/test_directional_ref"},
        // Light is chosen by power, not by place, with twice the variance of choosing evenly.
        Case{"spot_light/test_spot_direct.xml", "spot_light/refs/test_spot_ref", 3},
        Case{"projector/test_projector_constant_direct.xml",
             "projector/refs/test_projector_constant_ref"},
        Case{"projector/test_projector_textured_direct.xml",
             "projector/refs/test_projector_textured_ref"},
        Case{"mesh_attributes/test_mesh_attributes_1_face_direct.xml",
             "mesh_attributes/refs/test_mesh_attributes_1_face_ref"},
        Case{"mesh_attributes/test_mesh_attributes_3_face_direct.xml",
             "mesh_attributes/refs/test_mesh_attributes_3_face_ref"},
        Case{"mesh_attributes/test_mesh_attributes_3_vertex_direct.xml",
             "mesh_attributes/refs/test_mesh_attributes_3_vertex_ref"},
        Case{"various_emitters/test_various_emitters_ptracer.xml",
             "various_emitters/refs/test_various_emitters_ref"},
        Case{"texture_interp/test_texture_interp_direct.xml",
             "texture_interp/refs/test_texture_interp_ref"},
        Case{"instancing/test_instancing_path.xml", "instancing/refs/test_instancing_ref"},
        Case{"infinite_mirrors/scene_path.xml", "infinite_mirrors/refs/scene_ref"}),
    [](const testing::TestParamInfo<Case>& param) {
      std::string name = std::filesystem::path(param.param.reference).filename().string();
      name.erase(std::remove(name.begin(), name.end(), '_'), name.end());
      return name;
    });

}  // namespace
}  // namespace octolux::test
