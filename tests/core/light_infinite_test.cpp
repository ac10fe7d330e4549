// Point light, constant environment and environment map: orientation, interpolation, sampling.
#include <gtest/gtest.h>

#include "tests/core/light_cases.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

TEST(PointLight, InverseSquare) {
  const std::unique_ptr<Light> light = make_point_light({1, 2, 3}, {4, 8, 12});
  const std::optional<LightSample> s = light->sample({1, 2, 1}, {0.1f, 0.2f});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->wi, (Vec3{0, 0, 1}));
  EXPECT_EQ(s->radiance, (Rgb{1, 2, 3}));
  EXPECT_EQ(s->pdf_w, 1);
  EXPECT_TRUE(s->delta);
  EXPECT_EQ(s->at.position, (Vec3{1, 2, 3}));
  EXPECT_FALSE(light->sample({1, 2, 3}, {0.1f, 0.2f}));
  EXPECT_FALSE(make_point_light({0, 0, 0}, Rgb(0))->sample({1, 0, 0}, {0, 0}));
}

TEST(PointLight, NeverNan) {
  const std::unique_ptr<Light> light = make_point_light({0, 0, 0}, Rgb(1));
  for (float d = 1e-38f; d < 1e38f; d *= 10) {
    const std::optional<LightSample> s = light->sample({d, d, 0}, {0, 0});
    if (!s) continue;
    EXPECT_TRUE(is_finite(s->radiance) && is_finite(s->wi)) << d;
    if (d > 1e-6f && d < 1e6f) {
      EXPECT_NEAR(s->radiance.r * 2 * d * d, 1, 0x1p-21f) << d;
    }
  }
  EXPECT_TRUE(light->sample({1e-6f, 0, 0}, {0, 0}));
  EXPECT_TRUE(light->sample({1e6f, 0, 0}, {0, 0}));
}

TEST(ConstantLight, IsTheSameEverywhere) {
  const std::unique_ptr<EnvironmentLight> light = make_constant_light({1, 2, 3});
  const std::optional<LightSample> s = light->sample({9, 9, 9}, {0.2f, 0.7f});
  ASSERT_TRUE(s && s->infinite && !s->delta);
  EXPECT_EQ(s->radiance, light->radiance(s->wi));
  EXPECT_FLOAT_EQ(s->pdf_w * 4 * kPi, 1);
  EXPECT_EQ(light->pdf_w({0, 1, 0}), s->pdf_w);
  EXPECT_FALSE(make_constant_light(Rgb(0))->sample({0, 0, 0}, {0.5f, 0.5f}));
}

/// An uneven picture: dark texels, a bright one, colours, bright poles.
Image picture() {
  Image image(9, 6);
  for (int i = 0; i < 54; ++i) {
    const auto v = static_cast<float>((i * 17) % 13);
    image.pixels[i] = (i / 9 == 3) ? Rgb(0) : Rgb{v, 0.5f * v, static_cast<float>(i % 4)};
  }
  image.at(4, 2) = {300, 250, 200};
  return image;
}

/// Uneven turning; the last row mirrors.
const Affine kTurn = affine({0, 0, 1, 5, -0.6, 0.8, 0, 6, 0.8, 0.6, 0, 7});

Vec3 direction(double u, double v) {
  const double pi = std::acos(-1.0), theta = v * pi, phi = 2 * pi * u;
  return {static_cast<float>(std::sin(phi) * std::sin(theta)), static_cast<float>(std::cos(theta)),
          static_cast<float>(-std::cos(phi) * std::sin(theta))};
}

TEST(Envmap, TexelsLieWhereMitsubaPutsThem) {
  const Image image = picture();
  const std::unique_ptr<EnvironmentLight> light = make_envmap_light(image, Affine{}, 2);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 9; ++x) {
      if (y % 5 == 0) continue;  // poles are all columns at once
      const Rgb seen = light->radiance(direction((x + 0.5) / 9, y / 5.0));
      // Positions on the picture are known to a few 2^-24 of its width; neighbours differ by 600.
      EXPECT_NEAR(seen.r, 2 * image.at(x, y).r, 600 * 9 * 8 * 0x1p-24f) << x << " " << y;
      EXPECT_NEAR(seen.b, 2 * image.at(x, y).b, 600 * 9 * 8 * 0x1p-24f) << x << " " << y;
    }
  }
  // Half way between texels, and across the seam at -z.
  const Rgb between = light->radiance(direction(1.0 / 9, 1 / 5.0));
  EXPECT_NEAR(between.r, image.at(0, 1).r + image.at(1, 1).r, 0.01f);
  const Rgb seam = light->radiance({0, direction(0, 0.2).y, direction(0, 0.2).z});
  EXPECT_NEAR(seam.r, image.at(0, 1).r + image.at(8, 1).r, 0.01f);
}

TEST(Envmap, SamplesAtTheEdgeOfDarkRowsAreFinite) {
  Image image(4, 5);
  for (int x = 0; x < 4; ++x) image.at(x, 3) = Rgb(1);  // the cell above fades to black
  const std::unique_ptr<EnvironmentLight> light = make_envmap_light(image, Affine{}, 1);
  for (const float v : {0.0f, 0x1p-24f, 0.5f, kOneMinusEpsilon}) {
    const auto s = light->sample({}, {0.3f, v});
    if (s) {
      EXPECT_TRUE(is_finite(s->wi) && s->pdf_w > 0 && is_finite(s->radiance)) << v;
    }
  }
}

TEST(Envmap, MainDirections) {
  Image image(4, 5);  // columns centred on u = 1/8, 3/8, 5/8, 7/8
  for (int x = 0; x < 4; ++x) image.at(x, 2) = Rgb(static_cast<float>(x + 1));
  image.at(0, 0) = image.at(1, 0) = image.at(2, 0) = image.at(3, 0) = Rgb(9);
  const std::unique_ptr<EnvironmentLight> light = make_envmap_light(image, Affine{}, 1);
  const float h = std::sqrt(0.5f);
  EXPECT_NEAR(light->radiance({h, 0, -h}).r, 1, 1e-5f);   // u = 1/8: between -z and +x
  EXPECT_NEAR(light->radiance({h, 0, h}).r, 2, 1e-5f);    // u = 3/8: between +x and +z
  EXPECT_NEAR(light->radiance({-h, 0, h}).r, 3, 1e-5f);   // u = 5/8
  EXPECT_NEAR(light->radiance({-h, 0, -h}).r, 4, 1e-5f);  // u = 7/8
  EXPECT_NEAR(light->radiance({0, 1, 0}).r, 9, 1e-5f);    // the top row is up
  EXPECT_NEAR(light->radiance({0, -1, 0}).r, 0, 1e-5f);
}

TEST(Envmap, ToWorldTurnsIt) {
  const std::unique_ptr<EnvironmentLight> plain = make_envmap_light(picture(), Affine{}, 1);
  const std::unique_ptr<EnvironmentLight> turned = make_envmap_light(picture(), kTurn, 1);
  Affine origin = kTurn;
  for (auto& row : origin.m) row[3] = 0;
  Rng rng(1, Stream::test, 80, 0);
  for (int i = 0; i < 200; ++i) {
    const Vec3 w = sample_sphere(rng.uniform2());
    const Vec3 world = map(origin, {w.x, w.y, w.z});
    // 1e-6 of turning against a gradient of 300 per 1/9 of a turn.
    EXPECT_NEAR(turned->radiance(world).r, plain->radiance(w).r, 300 * 9 * 0x1p-20f);
  }
}

TEST(Envmap, SampleAgreesWithPdfAndRadiance) {
  const std::unique_ptr<EnvironmentLight> light = make_envmap_light(picture(), kTurn, 1);
  light->set_scene_bounds({}, std::sqrt(kInvPi));  // so that power is the integral of radiance
  const float total = luminance(light->power());
  Rng rng(1, Stream::test, 81, 0);
  for (int i = 0; i < 20000; ++i) {
    const std::optional<LightSample> s = light->sample({}, rng.uniform2());
    ASSERT_TRUE(s && s->infinite);
    EXPECT_EQ(s->pdf_w, light->pdf_w(s->wi));
    EXPECT_EQ(s->radiance, light->radiance(s->wi));
    // The density follows luminance but for sin theta over its mean in the cell, weighted by
    // luminance: at a pole the mean is at least int t (1 - t) dt / int 1 - t dt = 1/3.
    EXPECT_LE(luminance(s->radiance) / s->pdf_w, 3.01f * total);
  }
}

TEST(Envmap, DirectionsFollowPdf) {
  constexpr int kDraws = 200000, kTheta = 16, kPhi = 32, kSub = 16;
  const std::unique_ptr<EnvironmentLight> light = make_envmap_light(picture(), kTurn, 1);
  std::vector<double> counts(kTheta * kPhi, 0.0), expected(kTheta * kPhi, 0.0);
  Rng rng(1, Stream::test, 82, 0);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 wi = light->sample({}, rng.uniform2())->wi;
    const int row = std::min(kTheta - 1, static_cast<int>((wi.z + 1) / 2 * kTheta));
    const float turn = std::atan2(wi.y, wi.x) / (2 * kPi) + 0.5f;
    ++counts[row * kPhi + std::min(kPhi - 1, static_cast<int>(turn * kPhi))];
  }
  double sum = 0;
  for (int i = 0; i < kTheta * kSub; ++i) {
    for (int j = 0; j < kPhi * kSub; ++j) {
      const Vec3 wi = sample_sphere({1 - (i + 0.5f) / (kTheta * kSub), (j + 0.5f) / (kPhi * kSub)});
      const double share = 4 * std::acos(-1.0) / (kTheta * kPhi * kSub * kSub) * light->pdf_w(wi);
      expected[i / kSub * kPhi + (j / kSub + kPhi / 2) % kPhi] += kDraws * share;
      sum += share;
    }
  }
  EXPECT_NEAR(sum, 1, 0.002);  // midpoint rule with 131072 points on a density with 1/sin poles
  EXPECT_GT(chi2_test_p(counts, expected), kAlpha);
}

TEST(Envmap, PowerIsTheIntegralOfRadiance) {
  const std::unique_ptr<EnvironmentLight> light = make_envmap_light(picture(), kTurn, 1);
  light->set_scene_bounds({1, 2, 3}, 2);
  const Rgb power = light->power();
  Running uniform, sampled, emitted;
  Rng rng(1, Stream::test, 83, 0);
  for (int i = 0; i < 200000; ++i) {
    uniform.add(light->radiance(sample_sphere(rng.uniform2())).r * 16 * std::pow(std::acos(-1), 2));
    const std::optional<LightSample> s = light->sample({}, rng.uniform2());
    sampled.add(s->radiance.b / s->pdf_w * 4 * std::acos(-1.0));
    const Vec2 u = rng.uniform2();
    emitted.add(light->emit(u, rng.uniform2()).flux.g);
  }
  EXPECT_GT(z_test_p(uniform.z(power.r)), sidak(kAlpha, 3));
  EXPECT_GT(z_test_p(sampled.z(power.b)), sidak(kAlpha, 3));
  EXPECT_GT(z_test_p(emitted.z(power.g)), sidak(kAlpha, 3));
}

TEST(Envmap, GreyPictureIsTheConstantLight) {
  Image grey(3, 3);
  for (Rgb& c : grey.pixels) c = Rgb(2);
  const std::unique_ptr<EnvironmentLight> light = make_envmap_light(grey, Affine{}, 1);
  light->set_scene_bounds({}, 1);
  EXPECT_FLOAT_EQ(light->power().r, 8 * kPi * kPi);
  EXPECT_FLOAT_EQ(light->radiance({0.6f, 0.8f, 0}).r, 2);
}

TEST(Envmap, OddPicturesAreHarmless) {
  Image bad(4, 3);
  for (Rgb& c : bad.pixels) c = {-1, std::nanf(""), kInfinity};
  Image one(1, 1);
  one.at(0, 0) = Rgb(3);
  const std::unique_ptr<EnvironmentLight> dark = make_envmap_light(bad, Affine{}, 1);
  dark->set_scene_bounds({}, 1);
  EXPECT_EQ(dark->radiance({0, 0, 1}), Rgb(0));
  EXPECT_FALSE(dark->sample({}, {0.5f, 0.5f}));
  EXPECT_EQ(dark->pdf_w({0, 0, 1}), 0);
  EXPECT_EQ(dark->power(), Rgb(0));
  EXPECT_EQ(dark->emit({0.5f, 0.5f}, {0.5f, 0.5f}).flux, Rgb(0));
  const std::unique_ptr<EnvironmentLight> tiny = make_envmap_light(one, Affine{}, 1);
  for (const Vec3 w : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}, Vec3{1, 0, 0},
                       Vec3{-1e-20f, 0, -1}, Vec3{1e-20f, 1, 0}}) {
    EXPECT_FLOAT_EQ(tiny->radiance(w).r, 3);
    EXPECT_TRUE(std::isfinite(tiny->pdf_w(w)) && tiny->pdf_w(w) > 0);
  }
  for (const Vec2 u : {Vec2{0, 0}, Vec2{kOneMinusEpsilon, kOneMinusEpsilon}}) {
    const std::optional<LightSample> s = tiny->sample({}, u);
    ASSERT_TRUE(s);
    EXPECT_TRUE(std::isfinite(s->pdf_w) && is_finite(s->wi));
  }
}

}  // namespace
}  // namespace octolux
