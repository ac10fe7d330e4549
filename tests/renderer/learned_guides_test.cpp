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
constexpr Vec3 kSpot{0.6f, 0, 0.8f};

/// Photons on the unit square of a floor: even light, and a share of them from one direction, or
/// for x > 1/2 from its mirror image.
std::vector<Photon> on_floor(int count, double from_spot, std::uint64_t seed = 3) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Rng rng(seed, Stream::test, 11, static_cast<std::uint64_t>(i));
    const Vec2 at = rng.uniform2();
    const Vec3 spot{at.x > 0.5f ? -kSpot.x : kSpot.x, kSpot.y, kSpot.z};
    const Vec3 even = sample_cosine_hemisphere(rng.uniform2());
    const Vec3 wi = rng.uniform() < from_spot ? spot : even;
    photons.push_back({{at.x, at.y, 0}, wi, kUp, Rgb(1), 2, 0, kUp, true});
  }
  return photons;
}

LearnedGuides learned(const std::vector<Photon>& photons) {
  LearnedGuides guides;
  guides.add(photons);
  guides.build();
  return guides;
}

TEST(LearnedGuides, CellsKnowTheirOwnLight) {
  const LearnedGuides guides = learned(on_floor(20'000, 0.05));
  const Vec3 mirrored{-kSpot.x, kSpot.y, kSpot.z};
  for (const float y : {0.1f, 0.5f, 0.9f}) {
    const LearnedGuide *left = guides.find({0.2f, y, 0}, kUp),
                       *right = guides.find({0.8f, y, 0}, kUp);
    ASSERT_TRUE(left && right);
    EXPECT_GT(left->pdf_w(kSpot), 100 * cosine_hemisphere_pdf_w(kSpot));
    EXPECT_GT(right->pdf_w(mirrored), 100 * cosine_hemisphere_pdf_w(kSpot));
    EXPECT_LT(left->pdf_w(mirrored), 10 * cosine_hemisphere_pdf_w(kSpot));
    EXPECT_GT(left->unevenness(), 10);
  }
}

TEST(LearnedGuides, FindEvenLightEven) {
  // What one half of a cell's photons says of the other, which it does not know, is 1 in the mean.
  Running unevenness;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const LearnedGuides guides = learned(on_floor(400, 0, seed));  // one cell
    unevenness.add(guides.find({0.5f, 0.5f, 0}, kUp)->unevenness());
  }
  EXPECT_GT(z_test_p(unevenness.z(1)), kAlpha);
}

TEST(LearnedGuides, KnowNothingOfOtherFacesAndOfWhatDoesNotCount) {
  const LearnedGuides guides = learned(on_floor(1000, 0.1));
  EXPECT_FALSE(guides.find({0.5f, 0.5f, 0}, -kUp));
  EXPECT_FALSE(LearnedGuides().find({0.5f, 0.5f, 0}, kUp));
  std::vector<Photon> useless = on_floor(4, 0);
  useless[0].scattered = false;
  useless[1].flux = Rgb(0);
  useless[2].position.x = NAN;
  useless[3].flux = Rgb(kInfinity);
  EXPECT_FALSE(learned(useless).find({0.5f, 0.5f, 0}, kUp));
}

TEST(LearnedGuides, OneHeavyPhotonDoesNotHideTheOthers) {
  std::vector<Photon> photons = on_floor(400, 0.1);
  photons[0].wi = {-0.8f, 0, 0.6f};
  photons[0].flux = Rgb(4000);
  const LearnedGuides guides = learned(photons);
  const LearnedGuide* guide = guides.find({0.2f, 0.5f, 0}, kUp);
  ASSERT_TRUE(guide);
  EXPECT_GT(guide->pdf_w(kSpot), 10 * cosine_hemisphere_pdf_w(kSpot));
  EXPECT_GT(guide->unevenness(), 2);
}

TEST(LearnedGuides, WhereAFewBringMostOfTheLightNothingIsBelieved) {
  std::vector<Photon> photons = on_floor(400, 0.3);
  for (std::size_t i = 0; i < 5; ++i) photons[80 * i].flux = Rgb(100);
  const LearnedGuides guides = learned(photons);
  const LearnedGuide* guide = guides.find({0.2f, 0.5f, 0}, kUp);
  ASSERT_TRUE(guide);
  EXPECT_EQ(guide->unevenness(), 1);
}

TEST(LearnedGuides, SampleWhatTheirDensitySays) {
  const LearnedGuides guides = learned(on_floor(400, 0.3));
  const LearnedGuide& guide = *guides.find({0.2f, 0.5f, 0}, kUp);
  // Any density p has mean 1 of q / p, q the cosine's, over the part of the hemisphere where p > 0;
  // and mean(f / p) = integral of f there.
  Running area, height;
  int strays = 0;  // rounded over the edge of a square
  for (int i = 0; i < 100'000; ++i) {
    Rng rng(4, Stream::test, 11, static_cast<std::uint64_t>(i));
    const Vec3 w = guide.sample(rng.uniform2());
    const float p = guide.pdf_w(w);
    if (p == 0) ++strays;
    const float ratio = p == 0 ? 0 : cosine_hemisphere_pdf_w(w) / p;
    area.add(ratio);
    height.add(ratio * w.x);
  }
  EXPECT_LT(strays, 100);
  Running same_area, same_height;
  for (int i = 0; i < 100'000; ++i) {
    Rng rng(5, Stream::test, 11, static_cast<std::uint64_t>(i));
    const Vec3 w = sample_cosine_hemisphere(rng.uniform2());
    const float known = guide.pdf_w(w) > 0 ? 1.0f : 0.0f;
    same_area.add(known);
    same_height.add(known * w.x);
  }
  const auto p_of = [](const Running& a, const Running& b) {
    return z_test_p((a.mean() - b.mean()) / std::hypot(a.standard_error(), b.standard_error()));
  };
  EXPECT_GT(p_of(area, same_area), sidak(kAlpha, 2));
  EXPECT_GT(p_of(height, same_height), sidak(kAlpha, 2));
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
  // A closed room lit by a small bright patch of its floor: what is learned in cells of half a
  // metre is worse than what the photons nearby say, and must not take their place.
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
