// Interiors made by others (not part of this repository: skipped, saying so, where absent): photon
// mapping and the path tracer agree, per pixel and in the mean. Small pictures; the path tracer
// finds the light of these rooms so rarely that its noise is most of what the test allows.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

struct Case {
  const char* scene;
  int path_passes, photon_passes;
  std::int64_t photons;  // per pass and map
};

Rgb larger(Rgb a, Rgb b) { return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)}; }

/// Every pixel's variance, or the mean of its neighbourhood's where that is larger. Light that a
/// pixel finds once in thousands of samples makes its own variance a poor witness: where it was not
/// found, the pixel is too dark and seems sure of it.
Image careful_variance(const Film& film) {
  const Image own = film.variance();
  Image out = own;
  for (int y = 0; y < own.height; ++y) {
    for (int x = 0; x < own.width; ++x) {
      Rgb sum(0);
      int count = 0;
      for (int j = std::max(0, y - 1); j <= std::min(own.height - 1, y + 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(own.width - 1, x + 1); ++i, ++count) {
          sum += own.at(i, j);
        }
      }
      out.at(x, y) = larger(own.at(x, y), sum / static_cast<float>(count));
    }
  }
  return out;
}

/// Values beyond Sidak's limit at 0.01, as in Mitsuba's acceptance rule.
int values_apart(const Film& a, const Film& b) {
  const Image ma = a.radiance(), mb = b.radiance();
  const Image va = careful_variance(a), vb = careful_variance(b);
  const double limit = sidak(0.01, 3.0 * static_cast<double>(ma.pixels.size()));
  int apart = 0;
  for (std::size_t i = 0; i < ma.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double sigma = std::sqrt(static_cast<double>(va.pixels[i][c] + vb.pixels[i][c]));
      const double difference = static_cast<double>(ma.pixels[i][c] - mb.pixels[i][c]);
      apart += sigma > 0 ? z_test_p(difference / sigma) < limit : difference != 0;
    }
  }
  return apart;
}

class InteriorsAgreementSlow : public testing::TestWithParam<Case> {};

TEST_P(InteriorsAgreementSlow, PerPixelAndInTheMean) {
  const Case& c = GetParam();
  const std::string path = std::string(OCTOLUX_SOURCE_DIR) + "/../shared/scenes/" + c.scene;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << c.scene << " beside the repository";
  LoadOptions options;
  options.skip_missing = true;  // one comes without its teapots
  const auto scene = load_scene(path, options);
  scene->hide_emitters = true;  // see agreement_test.cpp
  resize_film(*scene, 24, 16);
  const Rendered a = rendered(*scene, path_config(c.path_passes));
  const Rendered b = rendered(*scene, photon_config(c.photon_passes, c.photons));
  const double mean = a.pass_means.mean();
  const double sigma = std::sqrt(a.pass_means.variance_of_mean() + b.pass_means.variance_of_mean());
  const int apart = values_apart(a.film, b.film), values = 3 * 24 * 16;
  std::printf("  %s: mean ratio %.4f +- %.4f, %d of %d values apart\n", c.scene,
              b.pass_means.mean() / mean, sigma / mean, apart, values);
  EXPECT_GT(mean, 0);
  EXPECT_NEAR(b.pass_means.mean(), mean, 0.005 * mean + 3 * sigma);
  EXPECT_LE(apart, static_cast<int>(0.0025 * values));
}

// With 64 passes of living-room, pixels whose light is rare state a third of the spread that they
// have between seeds.
INSTANTIATE_TEST_SUITE_P(Scenes, InteriorsAgreementSlow,
                         testing::Values(Case{"veach-ajar/scene.xml", 8192, 64, 100'000},
                                         Case{"living-room/scene.xml", 6144, 128, 100'000},
                                         Case{"aalto-door/scene.xml", 16384, 128, 100'000}),
                         [](const testing::TestParamInfo<Case>& param) {
                           return scene_name(param.param.scene);
                         });

}  // namespace
}  // namespace octolux::test
