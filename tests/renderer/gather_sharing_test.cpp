// renderer/gather_sharing.h: how far pixels share what they gather, and that it leaves the picture
// as it is, but for the noise.
#include "renderer/gather_sharing.h"

#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// Seen from 1 m above: a floor under a ceiling of this height, which may be missing.
std::unique_ptr<Scene> floor_under(double ceiling) {
  const std::string plate =
      "<shape type='rectangle'><transform name='to_world'><scale value='5000'/>"
      "<rotate x='1' angle='-90'/><translate y='";
  std::string xml = "<scene version='3.0.0'>" + sensor_xml("0, 1, 0", "0.3, 0, 0.1", 60, 32, 32) +
                    plate + "0'/></transform></shape>";
  if (ceiling > 0) xml += plate + std::to_string(ceiling) + "'/></transform></shape>";
  return scene_from(xml + "<emitter type='constant'/></scene>");
}

TEST(GatherSharing, ReachesAShareOfTheHarmonicMeanDistance) {
  RenderConfig config;
  config.eye.share = 0.2;
  const double height = 3;
  const std::vector<SharingLimit> limits = learn_sharing(*floor_under(height), config).limits();
  ASSERT_EQ(limits.size(), 32u * 32u);
  // A ray that leaves by the cosine c goes c^-1 as far as the ceiling is high: the mean of the
  // inverse, c, is 2/3, its variance 1/2 - 4/9. Two rays a pixel; those by the film's edges count
  // in fewer means, those near them in more.
  double nearness = 0;
  for (const SharingLimit& limit : limits) {
    nearness += config.eye.share * static_cast<double>(limit.nearness.times({0.6f, 0, 0.8f})) /
                static_cast<double>(limits.size());
  }
  const double sigma = std::sqrt((0.5 - 4.0 / 9) / (2.0 * 32 * 32)) / height;
  EXPECT_NEAR(nearness, 2.0 / 3 / height, 5 * sigma);
}

TEST(GatherSharing, ReachesAsFarAsPixelsGoUnderTheSky) {
  const GatherSharing sharing = learn_sharing(*floor_under(0), {});
  for (const SharingLimit& limit : sharing.limits()) EXPECT_EQ(limit.nearness.times({1, 1, 1}), 0);
}

TEST(Nearness, IsThatOfAThingAcrossItsSurfaceAndLessAlongIt) {
  const Vec3 along{0.36f, 0.48f, 0.8f}, across = normalize(cross(along, Vec3{1, 0, 0}));
  Nearness near;
  near.add(10, along, 2);
  EXPECT_FLOAT_EQ(near.times(along), 10);
  EXPECT_FLOAT_EQ(near.times(across), 2);
  EXPECT_NEAR(near.times(across + along), std::sqrt(2.0f) * (2 + 8 * 0.5f), 1e-5);
  EXPECT_FLOAT_EQ((near * 0.5f).times(along * -3), 15);
  EXPECT_EQ(near.times({}), 0);
  near.add(1, along, 2);  // farther than that: as near whatever the way
  EXPECT_FLOAT_EQ(near.times(along), 11);
  EXPECT_FLOAT_EQ(near.times(across), 3);
}

/// The floor of a room where it meets the wall at z = -2, the edge level in the picture.
TEST(GatherSharing, GoesAlongAnEdgeNotAcrossIt) {
  const auto scene =
      scene_from("<scene version='3.0.0'>" + sensor_xml("0, 1, 0.5", "0, 0, -2", 40, 32, 32) +
                 closed_room_xml(0.5) + "</scene>");
  const auto on_floor = [&](int x, int y) {
    const Ray ray = scene->camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f},
                                      {0.5f, 0.5f});
    return ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
  };
  int row = 31;
  while (on_floor(16, row - 1).z > -2) --row;
  ASSERT_GT(row, 8);
  ASSERT_LT(row, 28);
  const std::vector<SharingLimit> limits = learn_sharing(*scene, {}).limits();
  const float spacing = length(on_floor(17, row) - on_floor(16, row));
  for (int x = 4; x < 28; ++x) {
    const Nearness& limit = limits[static_cast<std::size_t>(row * 32 + x)].nearness;
    EXPECT_LT(limit.times({2 * spacing, 0, 0}), 1) << x;
    EXPECT_GT(limit.times({0, 0, 2 * spacing}), 1) << x;
  }
}

TEST(GatherSharing, IsLeftOutWhereNothingIsGathered) {
  RenderConfig off;
  off.eye.share = 0;
  EXPECT_FALSE(learn_sharing(*floor_under(3), off).any());
  off = {};
  off.eye.gather = false;
  EXPECT_FALSE(learn_sharing(*floor_under(3), off).any());
}

constexpr int kSize = 48, kBlock = 12;  // pixels

/// The mean of a block of pixels.
double block_mean(const Image& image, int block) {
  constexpr int kAcross = kSize / kBlock;
  double sum = 0;
  for (int i = 0; i < kBlock * kBlock; ++i) {
    const int x = block % kAcross * kBlock + i % kBlock, y = block / kAcross * kBlock + i / kBlock;
    sum += luminance(image.pixels[static_cast<std::size_t>(y) * kSize + x]);
  }
  return sum / (kBlock * kBlock);
}

/// Of indirect light, between the pictures of several seeds.
double mean_variance(const std::vector<Film>& films) {
  std::vector<Running> pixels(kSize * kSize);
  for (const Film& film : films) {
    const Image indirect = film.indirect();
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].add(luminance(indirect.pixels[i]));
  }
  double sum = 0;
  for (const Running& pixel : pixels) sum += pixel.variance();
  return sum / static_cast<double>(pixels.size());
}

/// Sharing leaves the mean of every block, and at most `most` of the noise.
void expect_less_noise(Scene& scene, double most) {
  resize_film(scene, kSize, kSize);
  RenderConfig config = photon_config(4, 20'000);
  config.eye.direct_samples = 0;  // not as noise asks: direct light is the same with and without
  const std::vector<Film> shared = render_seeds(scene, config, 8);
  config.eye.share = 0;
  const std::vector<Film> own = render_seeds(scene, config, 8);
  EXPECT_LT(mean_variance(shared), most * mean_variance(own));
  for (int block = 0; block < kSize * kSize / (kBlock * kBlock); ++block) {
    Running ratio;  // of the same photons
    for (std::size_t i = 0; i < own.size(); ++i) {
      ratio.add(block_mean(shared[i].radiance(), block) / block_mean(own[i].radiance(), block));
    }
    EXPECT_NEAR(ratio.mean(), 1, 0.002 + 4 * ratio.standard_error()) << block;
    EXPECT_LT(ratio.standard_error(), 0.002) << block;
  }
}

TEST(GatherSharing, LeavesThePictureAndTakesItsNoise) {
  expect_less_noise(*shipped_scene("cornell/cornell.xml"), 0.5);
}

/// A room, of which the eye sees nothing but its image in a mirror.
TEST(GatherSharingSlow, DoesSoInAMirror) {
  const auto scene =
      scene_from("<scene version='3.0.0'>" + sensor_xml("0, 2, 0", "0, 2, 1", 60, kSize, kSize) +
                 closed_room_xml(0.6) + R"(
    <shape type='rectangle'><transform name='to_world'><scale value='1.8'/><rotate y='1' angle='180'/>
      <translate y='2' z='1.9'/></transform>
      <bsdf type='conductor'><string name='material' value='none'/></bsdf></shape>
    <shape type='rectangle'><transform name='to_world'><scale value='0.7'/>
      <rotate x='1' angle='90'/><translate y='3.9'/></transform><emitter type='area'/></shape>
    </scene>)");
  Way mirrored;
  mirrored.add(false);
  const std::vector<SharingLimit> limits = learn_sharing(*scene, {}).limits();
  for (const SharingLimit& limit : limits) ASSERT_EQ(limit.way, mirrored);
  expect_less_noise(*scene, 0.5);
}

/// Varnish whose gloss is gathered with the base, and one whose gloss is followed.
TEST(GatherSharingSlow, DoesSoUnderACoat) {
  for (const char* alpha : {"0.3", "0.1"}) {
    const auto scene = scene_from(
        "<scene version='3.0.0'>" + sensor_xml("0, 2, -1.9", "0, 2, 0", 60, kSize, kSize) +
        "<shape type='cube'><transform name='to_world'><scale value='2'/><translate y='2'/>"
        "</transform><bsdf type='twosided'><bsdf type='roughplastic'><float name='alpha' value='" +
        alpha + R"('/><rgb name='diffuse_reflectance' value='0.6, 0.5, 0.3'/></bsdf></bsdf></shape>
        <shape type='rectangle'><transform name='to_world'><scale value='0.7'/>
          <rotate x='1' angle='90'/><translate y='3.9'/></transform><emitter type='area'/></shape>
        </scene>)");
    expect_less_noise(*scene, 0.6);
  }
}

}  // namespace
}  // namespace octolux::test
