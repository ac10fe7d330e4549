// The same command gives the same bytes: on 1, 2 and 7 threads, and run twice. Flux doubled doubles
// the picture to the bit.
#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel.h"
#include "renderer/picture.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

bool same_bytes(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

std::vector<Image> layers(const Film& film) {
  return {film.radiance(), film.direct(),   film.caustic(), film.indirect(),
          film.albedo(),   film.variance(), film.normal()};
}

class Determinism : public testing::TestWithParam<Integrator> {};

TEST_P(Determinism, ThreadsDoNotMatter) {
  const auto scene = shipped_scene("glass-sphere/glass-sphere.xml");
  resize_film(*scene, 40, 30);
  RenderConfig config = photon_config(3, 20'000, 7);
  config.integrator = GetParam();
  std::vector<std::vector<Image>> pictures;
  for (const int threads : {1, 2, 7, 7}) {
    const ThreadLimit limit(threads);
    pictures.push_back(layers(render_film(*scene, config)));
  }
  for (std::size_t p = 1; p < pictures.size(); ++p) {
    for (std::size_t l = 0; l < pictures[p].size(); ++l) {
      EXPECT_TRUE(same_bytes(pictures[0][l], pictures[p][l])) << "layer " << l << " run " << p;
    }
  }
}

TEST_P(Determinism, SeedsMatter) {
  const auto scene = shipped_scene("cornell/cornell.xml");
  resize_film(*scene, 16, 16);
  RenderConfig config = photon_config(1, 5'000, 1);
  config.integrator = GetParam();
  const Film first = render_film(*scene, config);
  config.seed = 2;
  EXPECT_FALSE(same_bytes(first.radiance(), render_film(*scene, config).radiance()));
}

INSTANTIATE_TEST_SUITE_P(Integrators, Determinism,
                         testing::Values(Integrator::photon, Integrator::path));

TEST(Linearity, TwiceTheFluxIsTwiceThePicture) {
  const std::string box =
      "<scene version='3.0.0'>" + sensor_xml("0, 0, 0.9", "0, -0.3, -1", 70, 24, 24) +
      "<shape type='cube'><boolean name='flip_normals' value='true'/></shape>"
      "<shape type='sphere'><float name='radius' value='0.3'/><bsdf type='dielectric'/></shape>"
      "<shape type='rectangle'><transform name='to_world'><scale value='0.3'/>"
      "<rotate x='1' angle='90'/><translate y='0.9'/></transform>"
      "<emitter type='area'><rgb name='radiance' value='$L'/></emitter></shape></scene>";
  const auto render_with = [&](const std::string& radiance) {
    std::string xml = box;
    xml.replace(xml.find("$L"), 2, radiance);
    return render_film(*scene_from(xml), photon_config(2, 10'000)).radiance();
  };
  const Image once = render_with("3, 2, 1");
  Image twice = render_with("6, 4, 2");
  for (Rgb& pixel : twice.pixels) pixel *= 0.5f;
  EXPECT_TRUE(same_bytes(once, twice));
}

}  // namespace
}  // namespace octolux::test
