// Scenes whose answer is known in closed form.
#include <gtest/gtest.h>

#include "renderer/photon_pass.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

std::string scene(const std::string& body) { return "<scene version='3.0.0'>" + body + "</scene>"; }

std::string diffuse(double rho) {
  return "<bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='" +
         std::to_string(rho) + "'/></bsdf></bsdf>";
}

std::string emitter(const std::string& radiance) {
  return "<emitter type='area'><rgb name='radiance' value='" + radiance + "'/></emitter>";
}

/// A rectangle of the given half sizes at height y that faces up or down.
std::string horizontal(double half_x, double half_z, double y, bool up, const std::string& inside) {
  return "<shape type='rectangle'><transform name='to_world'><scale x='" + std::to_string(half_x) +
         "' y='" + std::to_string(half_z) + "'/><rotate x='1' angle='" + (up ? "-90" : "90") +
         "'/><translate y='" + std::to_string(y) + "'/></transform>" + inside + "</shape>";
}

/// Form factor from a surface element to a parallel rectangle, half sizes a and b, centred at
/// distance h above it (four times the corner formula; Howell, configuration B-4).
double rectangle_form_factor(double a, double b, double h) {
  const double x = a / h, y = b / h;
  const double corner = (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
                         y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
                        (2 * std::numbers::pi);
  return 4 * corner;
}

TEST(ClosedForm, DirectLightOfARectangle) {
  const auto loaded = scene_from(
      scene(sensor_xml("3, 1, 0", "0, 0, 0", 0.2, 8, 8) + horizontal(4, 4, 0, true, diffuse(0.6)) +
            horizontal(0.7, 0.4, 1.5, false, diffuse(0) + emitter("5"))));
  const double expected = 0.6 * 5 * rectangle_form_factor(0.7, 0.4, 1.5);
  for (const RenderConfig& config : {path_config(64), photon_config(64, 1000)}) {
    const MeanRadiance seen = mean_radiance(render_film(*loaded, config));
    // Pixels span 0.2 degrees around the centre: the form factor changes there by less than 1e-4.
    EXPECT_NEAR(seen.mean, expected, 4 * seen.standard_error + 1e-4 * expected);
  }
}

/// A square of floor in the sun, and what it sends up to the underside of a small plate: no photon
/// need land there, however few there are.
TEST(ClosedForm, SunlightReflectedOnce) {
  const auto loaded =
      scene_from(scene(sensor_xml("0.5, 0.2, 0", "0, 1.5, 0", 0.2, 8, 8) +
                       horizontal(0.7, 0.4, 0, true, diffuse(0.6)) +
                       horizontal(0.02, 0.02, 1.5, false, diffuse(0.5)) +
                       "<emitter type='directional'><vector name='direction' x='3' y='-4' z='0'/>"
                       "<rgb name='irradiance' value='10'/></emitter>"));
  const double floor = 0.6 * 10 * 0.8 / std::numbers::pi;
  const double expected = 0.5 * floor * rectangle_form_factor(0.7, 0.4, 1.5);
  for (const RenderConfig& config : {path_config(64), photon_config(64, 100)}) {
    const MeanRadiance seen = mean_radiance(render_film(*loaded, config));
    EXPECT_NEAR(seen.mean, expected, 4 * seen.standard_error + 1e-4 * expected);
  }
}

TEST(ClosedForm, FluxBetweenFacingSquares) {
  // Two unit squares one apart: F = 0.19982 (Howell, configuration C-11, X = Y = 1).
  const double x = 1, y = 1;
  const double f = 2 / (std::numbers::pi * x * y) *
                   (std::log(std::sqrt((1 + x * x) * (1 + y * y) / (1 + x * x + y * y))) +
                    x * std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y)) +
                    y * std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) -
                    x * std::atan(x) - y * std::atan(y));
  const auto loaded = scene_from(scene(sensor_xml("3, 0.5, 0", "0, 0.5, 0", 40, 8, 8) +
                                       horizontal(0.5, 0.5, 0, true, diffuse(0.6)) +
                                       horizontal(0.5, 0.5, 1, false, diffuse(0) + emitter("2"))));
  const LightSampler lights(*loaded);
  loaded->max_depth = 2;
  const std::int64_t count = 200'000;
  double received = 0;
  for (const Photon& p :
       trace_photons(*loaded, lights, PhotonKind::global, count, {1, 0}).photons) {
    received += p.flux.g;
  }
  const double power = 2 * std::numbers::pi;  // pi L A
  const double sigma = std::sqrt(f * (1 - f) / count);
  EXPECT_NEAR(received / power, f, 4 * sigma);
}

TEST(ClosedForm, MirrorShowsTheLamp) {
  // Camera at the height of the lamp's image: the ray goes down to the mirror and up to the lamp.
  const std::string mirror =
      "<bsdf type='conductor'><string name='material' value='none'/>"
      "<rgb name='specular_reflectance' value='0.9'/></bsdf>";
  const auto loaded = scene_from(
      scene(sensor_xml("0, 1, -1", "0, 0, 0", 2, 8, 8) + horizontal(3, 3, 0, true, mirror) +
            horizontal(1, 1, 1.5, false, diffuse(0) + emitter("3, 2, 1"))));
  // The camera's rays meet the mirror around the origin and reach y = 1.5 around z = 1.5: move on.
  for (const RenderConfig& config : {path_config(2), photon_config(2, 1000)}) {
    const auto lamp_ahead = scene_from(
        scene(sensor_xml("0, 1, -1", "0, 0, 0", 2, 8, 8) + horizontal(3, 3, 0, true, mirror) +
              "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='180'/>"
              "<translate y='1' z='1'/></transform>" +
              diffuse(0) + emitter("3, 2, 1") + "</shape>"));
    for (const Rgb& pixel : render_film(*lamp_ahead, config).radiance().pixels) {
      EXPECT_NEAR(pixel.r, 2.7, 1e-5);
      EXPECT_NEAR(pixel.g, 1.8, 1e-5);
      EXPECT_NEAR(pixel.b, 0.9, 1e-5);
    }
    for (const Rgb& pixel : render_film(*loaded, config).radiance().pixels) {
      EXPECT_EQ(pixel.r, 0);  // the lamp overhead is not where the mirror looks
    }
  }
}

TEST(ClosedForm, PaneTransmitsWhatFresnelLeaves) {
  const std::string pane =
      "<bsdf type='thindielectric'><float name='int_ior' value='1.5'/>"
      "<float name='ext_ior' value='1'/></bsdf>";
  const double r = 0.2 * 0.2;  // ((1.5 - 1) / (1.5 + 1))^2
  const double transmitted = 1 - 2 * r / (1 + r);
  const auto seen_through = scene_from(scene(sensor_xml("0, 3, 0.001", "0, 0, 0", 1, 8, 8) +
                                             horizontal(1, 1, 1, true, pane) +
                                             horizontal(1, 1, 0, true, diffuse(0) + emitter("4"))));
  const auto lit_through =
      scene_from(scene(sensor_xml("2, 0.5, 0", "0, 0, 0", 0.2, 8, 8) +
                       horizontal(1, 1, 0, true, diffuse(0.5)) + horizontal(1, 1, 1, true, pane) +
                       "<emitter type='point'><point name='position' x='0' y='10' z='0'/>"
                       "<rgb name='intensity' value='100'/></emitter>"));
  for (const RenderConfig& config : {path_config(512), photon_config(512, 100)}) {
    const MeanRadiance seen = mean_radiance(render_film(*seen_through, config));
    EXPECT_NEAR(seen.mean, 4 * transmitted, 4 * seen.standard_error + 1e-4);
    lit_through->max_depth = 3;  // camera, wall, pane, lamp: no interreflection with the pane
    const MeanRadiance lit = mean_radiance(render_film(*lit_through, config));
    const double expected = 0.5 / std::numbers::pi * transmitted;  // 100 W/sr at 10 m: E = 1
    EXPECT_NEAR(lit.mean, expected, 4 * lit.standard_error + 1e-4 * expected);
  }
}

TEST(ClosedForm, NullIsNoSurface) {
  const std::string null = "<bsdf type='null'/>";
  const auto lit_through = scene_from(
      scene(sensor_xml("3, 1, 0", "0, 0, 0", 0.2, 8, 8) + horizontal(4, 4, 0, true, diffuse(0.6)) +
            horizontal(3.5, 3.5, 0.5, true, null) +
            horizontal(0.7, 0.4, 1.5, false, diffuse(0) + emitter("5"))));
  // A lamp that is no surface adds its light to that of the lamp behind it.
  const auto lamps = scene_from(scene(sensor_xml("0, 3, 0.001", "0, 0, 0", 1, 8, 8) +
                                      horizontal(1, 1, 1, true, null + emitter("3")) +
                                      horizontal(1, 1, 0, true, diffuse(0) + emitter("4"))));
  const double expected = 0.6 * 5 * rectangle_form_factor(0.7, 0.4, 1.5);
  for (const RenderConfig& config : {path_config(64), photon_config(64, 1000)}) {
    const MeanRadiance lit = mean_radiance(render_film(*lit_through, config));
    EXPECT_NEAR(lit.mean, expected, 4 * lit.standard_error + 1e-4 * expected);
    const MeanRadiance seen = mean_radiance(render_film(*lamps, config));
    EXPECT_NEAR(seen.mean, 7, 4 * seen.standard_error);
  }
}

TEST(ClosedForm, ASheetTransmitsDiffusely) {
  const std::string sheet = "<bsdf type='difftrans'><rgb name='transmittance' value='0.6'/></bsdf>";
  const std::string lamp =
      "<emitter type='point'><point name='position' x='0' y='10' z='0'/>"
      "<rgb name='intensity' value='100'/></emitter>";  // E = 1 on the sheet
  for (const bool up : {true, false}) {
    const std::string lit = horizontal(1, 1, 0, up, sheet) + lamp;
    const auto below = scene_from(scene(sensor_xml("1, -2, 0", "0, 0, 0", 0.2, 8, 8) + lit));
    const auto above = scene_from(scene(sensor_xml("1, 2, 0", "0, 0, 0", 0.2, 8, 8) + lit));
    for (const RenderConfig& config : {path_config(4), photon_config(4, 1000)}) {
      const double expected = 0.6 / std::numbers::pi;
      EXPECT_NEAR(mean_radiance(render_film(*below, config)).mean, expected, 1e-4 * expected);
      EXPECT_EQ(mean_radiance(render_film(*above, config)).mean, 0);
    }
  }
}

/// A closed room with a lamp; walls of reflectance rho.
std::unique_ptr<Scene> room(double rho) {
  return scene_from(scene(sensor_xml("0, 0, 0.9", "0, 0, -1", 60, 8, 8) +
                          "<shape type='cube'><boolean name='flip_normals' value='true'/>" +
                          diffuse(rho) + "</shape>" +
                          horizontal(0.3, 0.2, 0.9, false, diffuse(0) + emitter("7, 5, 3"))));
}

TEST(PhotonFlux, FirstHitsReceiveThePowerOfTheLights) {
  const auto loaded = room(0.5);
  loaded->max_depth = 2;  // photons of one segment only
  const PhotonPass pass =
      trace_photons(*loaded, LightSampler(*loaded), PhotonKind::global, 50'000, {3, 0});
  ASSERT_EQ(pass.photons.size(), 50'000u);
  double sum[3] = {};
  for (const Photon& p : pass.photons) {
    for (int c = 0; c < 3; ++c) sum[c] += p.flux[c];
  }
  const double area = 0.6 * 0.4;
  for (int c = 0; c < 3; ++c) {
    // Every photon carries the same flux: only rounding is left.
    EXPECT_NEAR(sum[c], std::numbers::pi * area * Rgb(7, 5, 3)[c], 2e-5 * sum[c]);
  }
}

TEST(PhotonFlux, AbsorbedPlusEscapedIsEmitted) {
  // An open floor and lamp inside a large black sphere that catches what escapes.
  const auto loaded = scene_from(scene(sensor_xml("3, 0.5, 0", "0, 0.5, 0", 40, 8, 8) +
                                       horizontal(1, 1, 0, true, diffuse(0.8)) +
                                       horizontal(1, 1, 1, false, diffuse(0.7)) +
                                       horizontal(0.2, 0.2, 0.8, false, diffuse(0) + emitter("1")) +
                                       "<shape type='sphere'><float name='radius' value='50'/>"
                                       "<boolean name='flip_normals' value='true'/>" +
                                       diffuse(0) + "</shape>"));
  const LightSampler lights(*loaded);
  const double power = std::numbers::pi * 0.16;
  Running balance;
  for (std::uint64_t pass = 0; pass < 40; ++pass) {
    double sum = 0;
    for (const Photon& p :
         trace_photons(*loaded, lights, PhotonKind::global, 5'000, {1, pass}).photons) {
      const double height = p.position.y;
      const double absorbed = length2(p.position) > 100 ? 1
                              : height > 0.9            ? 0.3
                              : height < 0.1            ? 0.2
                                                        : 1;
      sum += absorbed * p.flux.g;
    }
    balance.add(sum / power);
  }
  EXPECT_LT(std::abs(balance.z(1)), 4) << balance.mean() << " +- " << balance.standard_error();
}

TEST(PhotonFlux, MapsOfAFloorLitByALampHoldItsIrradiance) {
  // Gather off shows the map itself: its mean over the whole floor is the lamp's direct light plus
  // nothing (walls are black), so the centre has the closed form of the first test.
  const auto loaded = scene_from(
      scene(sensor_xml("3, 1, 0", "0, 0, 0", 0.2, 4, 4) + horizontal(4, 4, 0, true, diffuse(0.6)) +
            horizontal(0.7, 0.4, 1.5, false, diffuse(0) + emitter("5"))));
  const double expected = 0.6 * 5 * rectangle_form_factor(0.7, 0.4, 1.5);
  for (const std::string kernel : {"disc", "cone"}) {
    RenderConfig config = photon_config(32, 50'000);
    config.eye.gather = false;
    config.estimator.kernel = kernel;
    const Running passes = pass_means(*loaded, config);
    // Bandwidth h = sqrt(20 / (pi * density)) is about 0.06: curvature of E over it adds h^2/8 of
    // the Laplacian, below 0.3 %.
    EXPECT_NEAR(passes.mean(), expected, 4 * passes.standard_error() + 0.003 * expected) << kernel;
  }
}

}  // namespace
}  // namespace octolux::test
