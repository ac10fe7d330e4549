// Every kind of emitter, seen twice: the photon map alone (no gathering, no next-event estimation)
// and the path tracer with direct light only. What photons carry must be what light sampling finds.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/image_io.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

struct Case {
  const char* name;
  const char* emitter;
  const char* bsdf = "<bsdf type='diffuse'><rgb name='reflectance' value='0.6, 0.5, 0.4'/></bsdf>";
  const char* shape = "";  // instead of the floor
};

constexpr const char* kBump =
    "<bsdf type='bumpmap'><texture type='bitmap'><string name='filename' value='waves.png'/>"
    "</texture><float name='scale' value='2'/><bsdf type='diffuse'/></bsdf>";
/// A smooth-shaded roof: normals lean outwards by 30 degrees, faces by about 11.
constexpr const char* kRoof =
    "v -8 0 8\nv 0 1.6 8\nv 8 0 8\nv -8 0 -8\nv 0 1.6 -8\nv 8 0 -8\nvn -0.5 0.866 0\nvn 0 1 0\n"
    "vn 0.5 0.866 0\nf 1//1 2//2 5//2 4//1\nf 2//2 3//3 6//3 5//2\n";

class EmittersAgreementSlow : public testing::TestWithParam<Case> {
 protected:
  static std::unique_ptr<Scene> load(const Case& c) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("octolux_emitters_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    Image waves(16, 16);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) waves.at(x, y) = Rgb(x % 8 < 4 ? 0.8f : 0.2f);
    }
    write_png((folder / "waves.png").string(), waves);
    std::ofstream(folder / "roof.obj") << kRoof;
    const bool roof = c.shape[0] != 0;
    const std::string floor =
        roof ? std::string("<shape type='obj'><string name='filename' value='roof.obj'/>")
             : "<shape type='rectangle'><transform name='to_world'><scale value='8'/>"
               "<rotate x='1' angle='-90'/></transform>";
    std::ofstream(folder / "scene.xml")
        << "<scene version='3.0.0'>" +
               sensor_xml("0.1, 6, 3", roof ? "2, 1, 0" : "0, 0, 0", 20, 8, 8) + floor + c.bsdf +
               "</shape>" + c.emitter + "</scene>";
    auto scene = load_scene((folder / "scene.xml").string(), {});
    std::filesystem::remove_all(folder);
    scene->max_depth = 2;  // direct light: the floor is lit by the emitter alone
    return scene;
  }
};

TEST_P(EmittersAgreementSlow, PhotonsCarryWhatLightSamplingFinds) {
  const auto scene = load(GetParam());
  RenderConfig photon = photon_config(64, 400'000);
  photon.eye.gather = false;
  photon.estimator.kernel = "disc";
  const Running by_photons = pass_means(*scene, photon);
  const Running by_path = pass_means(*scene, path_config(1024));
  const double sigma = std::sqrt(by_photons.variance_of_mean() + by_path.variance_of_mean());
  std::printf("  %s: ratio %.4f +- %.4f\n", GetParam().name, by_photons.mean() / by_path.mean(),
              sigma / by_path.mean());
  EXPECT_GT(by_path.mean(), 0);
  // The disc's bandwidth, about 0.05, blurs over creases and texels: half a per cent.
  EXPECT_NEAR(by_photons.mean(), by_path.mean(), 4 * sigma + 0.005 * by_path.mean());
}

constexpr const char* kSpot =
    "<emitter type='spot'><transform name='to_world'><lookat origin='1, 5, 1' target='0, 0, 0' "
    "up='0, 0, 1'/></transform><float name='cutoff_angle' value='40'/></emitter>";
constexpr const char* kSun =
    "<emitter type='directional'><vector name='direction' value='0.4, -1, 0.3'/></emitter>";
constexpr const char* kSunsky =
    "<emitter type='sunsky'><vector name='sun_direction' value='0.5, 0.7, 0.4'/></emitter>";
constexpr const char* kLamp =
    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='90'/>"
    "<translate y='3' x='2'/></transform><bsdf type='diffuse'><rgb name='reflectance' "
    "value='0'/></bsdf><emitter type='area'><texture name='radiance' type='checkerboard'>"
    "<rgb name='color0' value='5, 4, 3'/><rgb name='color1' value='0.1'/></texture></emitter>"
    "</shape>";
constexpr const char* kGrey = "<bsdf type='diffuse'/>";

INSTANTIATE_TEST_SUITE_P(Kinds, EmittersAgreementSlow,
                         testing::Values(Case{"spot", kSpot}, Case{"directional", kSun},
                                         Case{"sunsky", kSunsky}, Case{"textured_lamp", kLamp},
                                         Case{"bumped_floor", kSun, kBump},
                                         Case{"smooth_roof", kSun, kGrey, kRoof},
                                         Case{"smooth_roof_sky", kSunsky, kGrey, kRoof}),
                         [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace octolux::test
