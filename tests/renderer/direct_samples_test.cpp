// renderer/direct_samples.h: how many samples of direct light alone are worth it, and that they
// leave the picture as it is, but for the noise.
#include "renderer/direct_samples.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

constexpr int kSize = 48;  // pixels across
constexpr std::size_t kPixels = kSize * kSize;

/// A pass over a picture of 3 with this much noise [standard deviation] in each path class.
PassImage noisy_pass(float direct, float caustic, float indirect, std::uint64_t seed) {
  Rng rng(seed, Stream::test, 0, 0);
  const auto noise = [&](float deviation) {  // uniform, of this deviation
    return Rgb(deviation * std::sqrt(12.0f) * (rng.uniform() - 0.5f));
  };
  PassImage image(kPixels);
  for (EyeSample& pixel : image) {
    pixel.direct = Rgb(1) + noise(direct);
    pixel.caustic = Rgb(1) + noise(caustic);
    pixel.indirect = Rgb(1) + noise(indirect);
  }
  return image;
}

Film film_of(const PassImage& pass) {
  Film film(kSize, kSize);
  film.add(pass);
  return film;
}

std::int64_t wanted(float direct, float caustic, float indirect, std::int64_t taken = 0) {
  return wanted_direct_samples(film_of(noisy_pass(direct, caustic, indirect, 1)),
                               noisy_pass(direct, caustic, indirect, 2), taken);
}

TEST(WantedDirectSamples, FollowNeymansAllocation) {
  // sqrt(10 V / v) - 1, its integers far from the halves between them: V / v is known to 5 %.
  EXPECT_EQ(wanted(0.1f, 0, 0.1f), 2);     // 2.16
  EXPECT_EQ(wanted(0, 0.1f, 0.1f), 2);     // caustics count alike
  EXPECT_EQ(wanted(0.1f, 0.1f, 0.1f), 3);  // sqrt(20) - 1 = 3.47, to 0.1
  EXPECT_EQ(wanted(0.2f, 0, 0.1f), 5);     // 5.32
  EXPECT_EQ(wanted(0.03f, 0, 0.1f), 0);    // -0.05
  EXPECT_EQ(wanted(0.1f, 0, 0.2f, 1), 1);  // sqrt(5) - 1 = 1.24: V is twice what is seen
  EXPECT_EQ(wanted(0.1f, 0, 0.1f, 3), 5);  // sqrt(40) - 1 = 5.32
}

TEST(WantedDirectSamples, AreNoneWithoutNoiseAndManyWithoutOther) {
  EXPECT_EQ(wanted(0, 0, 0), 0);
  EXPECT_EQ(wanted(0, 0, 0.1f), 0);
  EXPECT_EQ(wanted(0.1f, 0, 0), 15);
}

TEST(WantedDirectSamples, ASpeckCountsAsOnePixel) {
  const PassImage first = noisy_pass(0.03f, 0, 0.1f, 1);
  PassImage second = noisy_pass(0.03f, 0, 0.1f, 2);
  second[kPixels / 2].direct = Rgb(1e8f);
  // That pixel's 1 beside the others' 0.46, and 5.1 of indirect light's: 0.69, not 1.96.
  EXPECT_EQ(wanted_direct_samples(film_of(first), second, 0), 1);
}

TEST(WantedDirectSamples, ABlackPictureAsksForNone) {
  EXPECT_EQ(wanted_direct_samples(film_of(PassImage(kPixels)), PassImage(kPixels), 1), 0);
}

std::vector<Film> films_with(const Scene& scene, int direct_samples) {
  RenderConfig config = photon_config(4, 5'000);
  config.eye.direct_samples = direct_samples;
  config.eye.learn = false;  // saves time
  return render_seeds(scene, config, 20);
}

/// Direct light and caustics, over the picture.
double mean_direct(const Film& film, int c) {
  double sum = 0;
  for (const Image& layer : {film.direct(), film.caustic()}) {
    for (const Rgb& pixel : layer.pixels) sum += pixel[c];
  }
  return sum / kPixels;
}

/// Variance of direct light between pictures, of the median pixel: on glass few have nearly all.
double direct_noise(const std::vector<Film>& films) {
  std::vector<Running> pixels(kPixels);
  for (const Film& film : films) {
    const Image direct = film.direct();
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].add(direct.pixels[i].g);
  }
  std::ranges::nth_element(pixels, pixels.begin() + kPixels / 2, {}, &Running::variance);
  return pixels[kPixels / 2].variance();
}

class DirectSamples : public testing::TestWithParam<const char*> {};

TEST_P(DirectSamples, LeaveThePictureAndTakeItsNoise) {
  const auto scene = shipped_scene(GetParam());
  resize_film(*scene, kSize, kSize);
  scene->hide_emitters = true;  // their edges are the same in all pixels of a pass
  const std::vector<Film> without = films_with(*scene, 0), with = films_with(*scene, 7);
  for (int c = 0; c < 3; ++c) {
    Running difference, mean;
    for (std::size_t i = 0; i < with.size(); ++i) {
      difference.add(mean_direct(with[i], c) - mean_direct(without[i], c));
      mean.add(mean_direct(with[i], c));
    }
    EXPECT_NEAR(difference.mean(), 0, 4.5 * difference.standard_error()) << c;
    EXPECT_LT(difference.standard_error(), 0.015 * mean.mean()) << c;
  }
  // Eight times as many samples, and more than as much by spreading them evenly.
  EXPECT_LT(direct_noise(with), direct_noise(without) / 4);
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].indirect().pixels, without[i].indirect().pixels);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectSamples,
                         testing::Values("cornell/cornell.xml", "glass-sphere/glass-sphere.xml"),
                         [](const auto& param) {
                           return std::string(param.param).starts_with("c") ? "Cornell" : "Glass";
                         });

TEST(DirectSamples, AreAskedForBySceneAndSetting) {
  const auto taken = [](const Scene& scene, RenderConfig config) {
    Watch watch;
    const Progress progress = render(scene, config, watch).progress;
    return std::pair(progress.direct_samples, progress.direct_grids);
  };
  const auto scene = shipped_scene("glass-sphere/glass-sphere.xml");
  resize_film(*scene, 32, 32);
  RenderConfig config = photon_config(4, 5'000);
  const auto [chosen, grids] = taken(*scene, config);
  EXPECT_GT(chosen, 2);
  EXPECT_EQ(grids, 2 + 2 + 2 * chosen);
  config.eye.direct_samples = 3;
  EXPECT_EQ(taken(*scene, config), std::pair(std::int64_t{3}, std::int64_t{12}));
  config = photon_config(4, 5'000);
  config.eye.gather = false;
  EXPECT_EQ(taken(*scene, config), std::pair(std::int64_t{0}, std::int64_t{0}));
  EXPECT_EQ(taken(*scene, path_config(4)), std::pair(std::int64_t{0}, std::int64_t{0}));
}

TEST(DirectSamples, AreTheSameAfterABreak) {
  const auto scene = shipped_scene("glass-sphere/glass-sphere.xml");
  resize_film(*scene, 32, 32);
  const RenderConfig whole = photon_config(4, 5'000);
  const Image expected = render_film(*scene, whole).radiance();
  for (const int before : {1, 2, 3}) {
    Watch watch;
    RenderResult start = render(*scene, photon_config(before, 5'000), watch);
    const RenderResult result = render(*scene, whole, watch, std::move(start));
    EXPECT_EQ(result.film.radiance().pixels, expected.pixels) << before;
  }
}

}  // namespace
}  // namespace octolux::test
