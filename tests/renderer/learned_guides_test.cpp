// renderer/learned_guides.h: cells know where their light came from, and no other's; and renders
// that learn have the same mean and no more noise.
#include "renderer/learned_guides.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "core/sampling.h"
#include "tests/renderer/renders.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

constexpr Vec3 kUp{0, 0, 1};
constexpr Vec3 kLamp{3, 0.5f, 4};  // [m]

/// Photons on the unit square of a floor: even light from 4 m up, and a share of them from a lamp,
/// or for x > 1/2 from its mirror image at x = -2.
std::vector<Photon> on_floor(int count, double from_lamp, std::uint64_t seed = 3) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Rng rng(seed, Stream::test, 11, static_cast<std::uint64_t>(i));
    const Vec2 at = rng.uniform2();
    const Vec3 position{at.x, at.y, 0};
    const Vec3 lamp{at.x > 0.5f ? 1 - kLamp.x : kLamp.x, kLamp.y, kLamp.z};
    const Vec3 even = sample_cosine_hemisphere(rng.uniform2());
    const Vec3 way = rng.uniform() < from_lamp ? lamp - position : even * (4 / even.z);
    photons.push_back({position, normalize(way), kUp, Rgb(1), 2, 0, kUp, length(way)});
  }
  return photons;
}

LearnedGuides learned(const std::vector<Photon>& photons) {
  LearnedGuides guides;
  guides.add(photons);
  guides.build();
  return guides;
}

/// How many times as often as by the cosine directions are chosen at `p` that point to `there`.
double times(const LearnedGuides& guides, Vec3 p, Vec3 there) {
  const Vec3 wi = normalize(there - p);
  return guides.at(p, kUp).pdf_w(wi) / cosine_hemisphere_pdf_w(wi);
}

TEST(LearnedGuides, CellsKnowTheirOwnLight) {
  const LearnedGuides guides = learned(on_floor(20'000, 0.1));
  const Vec3 mirrored{1 - kLamp.x, kLamp.y, kLamp.z};
  for (const float y : {0.1f, 0.5f, 0.9f}) {
    const Vec3 left{0.2f, y, 0}, right{0.8f, y, 0};
    EXPECT_GT(times(guides, left, kLamp), 30);
    EXPECT_GT(times(guides, right, mirrored), 30);
    EXPECT_LT(times(guides, left, mirrored), 3);
    ASSERT_TRUE(guides.find(left, kUp));
    EXPECT_GT(guides.find(left, kUp)->unevenness, 3);
  }
}

TEST(LearnedGuides, FindEvenLightEvenAndDoNotFollowIt) {
  // What one half of a cell's photons says of the other, which it does not know, would be 1 in the
  // mean; lobes reach below the horizon with what is missing above.
  Running unevenness;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const LearnedGuides guides = learned(on_floor(400, 0, seed));  // one cell
    unevenness.add(guides.find({0.5f, 0.5f, 0}, kUp)->unevenness);
    EXPECT_TRUE(guides.at({0.5f, 0.5f, 0}, kUp).empty());
  }
  EXPECT_LT(unevenness.mean(), 1 + 5 * unevenness.standard_error());
  EXPECT_GT(unevenness.mean(), 0.8);
}

TEST(LearnedGuides, KnowNothingOfOtherFacesAndOfWhatDoesNotCount) {
  const LearnedGuides guides = learned(on_floor(1000, 0.1));
  EXPECT_FALSE(guides.find({0.5f, 0.5f, 0}, -kUp));
  EXPECT_TRUE(guides.at({0.5f, 0.5f, 0}, -kUp).empty());
  EXPECT_FALSE(LearnedGuides().find({0.5f, 0.5f, 0}, kUp));
  std::vector<Photon> useless = on_floor(4, 0);
  useless[0].flown = 0;
  useless[1].flux = Rgb(0);
  useless[2].position.x = NAN;
  useless[3].flux = Rgb(kInfinity);
  EXPECT_FALSE(learned(useless).find({0.5f, 0.5f, 0}, kUp));
}

TEST(LearnedGuides, HeavyPhotonsDoNotHideTheOthers) {
  std::vector<Photon> photons = on_floor(400, 0.1);
  for (std::size_t i = 0; i < 5; ++i) {
    photons[80 * i].wi = {-0.8f, 0, 0.6f};
    photons[80 * i].flux = Rgb(400);
  }
  const LearnedGuides guides = learned(photons);
  EXPECT_GT(times(guides, {0.2f, 0.5f, 0}, kLamp), 5);
  EXPECT_GT(guides.find({0.2f, 0.5f, 0}, kUp)->unevenness, 2);
}

struct Renders {
  Running means;      // of whole pictures
  Running variances;  // of each pixel between them, relative
};

Renders renders(const Scene& scene, bool learn) {
  RenderConfig config = photon_config(2, 100'000);
  config.eye.learn = learn;
  const std::vector<Film> films = render_seeds(scene, config, 8);
  Renders out;
  for (const Film& film : films) out.means.add(mean_radiance(film).mean);
  for (const Running& pixel : each_pixel(films)) {
    out.variances.add(pixel.variance() / (pixel.mean() * pixel.mean()));
  }
  return out;
}

TEST(LearnedGuides, RendersThatLearnHaveTheSameMeanAndNoMoreNoise) {
  // A closed room lit by a small bright patch of its floor.
  const auto scene =
      scene_from("<scene version='3.0.0'>" + sensor_xml("-1.9, 2, 0", "2, 2, 0", 40, 48, 48) +
                 closed_room_xml(0.6) + R"(
    <emitter type='spot'><rgb name='intensity' value='10'/><float name='cutoff_angle' value='4'/>
      <transform name='to_world'><lookat origin='0, 3.9, 0' target='0, 0, 0' up='1, 0, 0'/>
      </transform></emitter></scene>)");
  const Renders off = renders(*scene, false), on = renders(*scene, true);
  EXPECT_NE(on.means.mean(), off.means.mean());
  const double error = std::hypot(on.means.standard_error(), off.means.standard_error());
  EXPECT_GT(z_test_p((on.means.mean() - off.means.mean()) / error), kAlpha);
  const double spread = std::hypot(on.variances.standard_error(), off.variances.standard_error());
  std::printf("  variance, learned / unlearned %.3f +- %.3f\n",
              on.variances.mean() / off.variances.mean(), spread / off.variances.mean());
  EXPECT_LT(on.variances.mean(), off.variances.mean() + 3 * spread);
}

}  // namespace
}  // namespace octolux::test
