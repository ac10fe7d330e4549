// Bars, leaves, cornices: surfaces narrower than a look-up, which reaches over gaps where no photon
// can land (RecordSites::is_detail). In a room full of bars, with so few photons that 20 of them
// reach over several bars, photon mapping finds the path tracer's light.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

std::string bar(const char* half_size, double x, double z) {
  return fmt::format(
      "<shape type='cube'><transform name='to_world'><scale value='{}'/><translate x='{}' y='2' "
      "z='{}'/></transform><ref id='white'/></shape>",
      half_size, x, z);
}

/// A lamp in a room whose walls stand behind upright bars, 4 by 8 cm, 16 cm apart.
std::string barred_room() {
  std::string xml =
      "<scene version='3.0.0'><integrator type='path'><integer name='max_depth' value='5'/>"
      "</integrator>" +
      sensor_xml("0, 1.2, 1.8", "0, 1, -1", 60, 24, 16) +
      "<bsdf type='twosided' id='white'><bsdf type='diffuse'><rgb name='reflectance' value='0.7'/>"
      "</bsdf></bsdf>" +
      closed_room_xml(0.7) +
      "<shape type='rectangle'><transform name='to_world'><scale value='0.4'/>"
      "<rotate x='1' angle='90'/><translate y='3.9'/></transform>"
      "<emitter type='area'><rgb name='radiance' value='20'/></emitter></shape>";
  for (int i = 0; i < 24; ++i) {
    const double along = 0.16 * i - 1.92;
    xml += bar("0.02, 2, 0.04", along, -1.5);
    xml += bar("0.04, 2, 0.02", -1.5, along);
    xml += bar("0.04, 2, 0.02", 1.5, along);
  }
  return xml + "</scene>";
}

/// The mean of a picture by each of five seeds. Passes of one seed complement each other, so their
/// spread would say too much.
Running seed_means(const Scene& scene, const RenderConfig& config) {
  Running means;
  for (const Film& film : render_seeds(scene, config, 5)) means.add(mean_radiance(film).mean);
  return means;
}

/// Look-ups there lost 6 % of the room's light; 1 % is left.
TEST(Details, AreNotRead) {
  const auto scene = scene_from(barred_room());
  const Running path = seed_means(*scene, path_config(256));
  const Running photon = seed_means(*scene, photon_config(16, 20'000));
  const double sigma = std::sqrt(path.variance_of_mean() + photon.variance_of_mean());
  std::printf("  %.4f +- %.4f\n", photon.mean() / path.mean(), sigma / path.mean());
  EXPECT_LT(sigma, 0.005 * path.mean());
  EXPECT_NEAR(photon.mean(), path.mean(), 0.02 * path.mean() + 2 * sigma);
}

}  // namespace
}  // namespace octolux::test
