// Directional lights, spots, textured lamps, daylight: the same light by next-event estimation and
// by photons, powers in closed form, and the sun's place against the almanac.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "core/sky.h"
#include "core/spectrum.h"
#include "core/texture.h"
#include "tests/core/light_window.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

TEST(DirectionalLight, SameFluxByPhotonsAndByNextEventEstimation) {
  const Vec3 direction = normalize({0.3f, -1, 0.2f});
  const auto light = make_directional_light(direction, {1, 2, 3});
  light->set_scene_bounds({0.4f, 0, 0}, 1.5f);
  EXPECT_FLOAT_EQ(light->power().g, 2 * kPi * 2.25f);
  const auto s = light->sample({0.1f, 0.2f, 0.3f}, {0.5f, 0.5f});
  ASSERT_TRUE(s && s->delta && s->infinite);
  EXPECT_EQ(s->wi, -direction);
  const Window window{{0.5f, -0.3f, 0.2f}, Frame::from_normal(normalize({0.2f, 1, -0.1f})), 0.4f};
  EXPECT_GT(same_flux_p(*light, window, 50), kAlpha);
}

SpotConfig spot() {
  // Looks down -y from (0, 2, 0); local x is world x.
  SpotConfig config;
  config.to_world = affine({1, 0, 0, 0, 0, 0, -1, 2, 0, 1, 0, 0});
  config.intensity = {3, 2, 1};
  config.cutoff = 0.5f;
  config.beam = 0.3f;
  return config;
}

TEST(SpotLight, PowerInClosedForm) {
  // 2 pi (1 - cos b) inside the beam, then the linear fade: cos b - (sin c - sin b) / (c - b).
  const double b = 0.3, c = 0.5;
  const double solid = 2 * std::numbers::pi *
                       ((1 - std::cos(b)) + std::cos(b) - (std::sin(c) - std::sin(b)) / (c - b));
  // 16384 points of a low-discrepancy set on a function with a kink.
  EXPECT_NEAR(make_spot_light(spot())->power().r, 3 * solid, 1e-3 * 3 * solid);
}

TEST(SpotLight, FadesLinearlyWithTheAngle) {
  const auto light = make_spot_light(spot());
  const auto seen = [&](float angle) {
    const auto s = light->sample({2 * std::tan(angle), 0, 0}, {0.5f, 0.5f});
    const float d = 2 / std::cos(angle);
    return s ? s->radiance.r * d * d : 0;
  };
  EXPECT_NEAR(seen(0), 3, 1e-5);
  EXPECT_NEAR(seen(0.29f), 3, 1e-5);
  EXPECT_NEAR(seen(0.4f), 1.5, 1e-4);
  EXPECT_EQ(seen(0.51f), 0);
  EXPECT_FALSE(light->sample({0, 4, 0}, {0.5f, 0.5f}));  // behind
}

TEST(SpotLight, SameFluxByPhotonsAndByNextEventEstimation) {
  Image image(2, 2);
  image.at(0, 0) = Rgb(1), image.at(1, 0) = Rgb(0.2f), image.at(0, 1) = Rgb(0.5f);
  const auto slide = make_bitmap_texture(image, {});
  for (const Texture* texture :
       {static_cast<const Texture*>(nullptr), static_cast<const Texture*>(slide.get())}) {
    SpotConfig config = spot();
    config.texture = texture;
    const auto light = make_spot_light(config);
    const Window window{{0.2f, 0, -0.1f}, Frame::from_normal(normalize({0.1f, 1, 0.2f})), 0.6f};
    EXPECT_GT(same_flux_p(*light, window, 51), sidak(kAlpha, 2));
    Running flux;
    Rng rng(1, Stream::test, 90, texture ? 1 : 0);
    for (int i = 0; i < 40000; ++i) {
      flux.add(static_cast<double>(light->emit({0, 0}, rng.uniform2()).flux.g));
    }
    const double power = static_cast<double>(light->power().g);
    EXPECT_NEAR(flux.mean(), power, 5 * flux.standard_error() + 1e-3 * power);
  }
}

TEST(TexturedAreaLight, SameFluxByPhotonsAndByNextEventEstimation) {
  const auto texture = make_checkerboard_texture({4, 2, 1}, Rgb(0.1f), scaling(2, 2, 1));
  Shape flat = rectangle(1, 0.5f);
  auto& mesh = std::get<TriangleMesh>(flat.geometry);
  for (const Vec3 p : mesh.positions) mesh.uvs.push_back({(p.x + 1) / 2, p.y + 0.5f});
  const Affine uneven = affine({0.8, -0.5, 0.2, 0.3, 0.6, 1.1, -0.1, -0.2, 0.1, 0.3, 0.4, 0.5});
  const Affine similar = affine({0, -1.5, 0, 1, 1.5, 0, 0, 2, 0, 0, 1.5, 3});
  const Shape ball = quadric(Quadric::Kind::sphere, similar);
  const Shape egg = quadric(Quadric::Kind::sphere, uneven);
  int test = 0;
  for (const Shape* shape : std::array<const Shape*, 3>{&flat, &ball, &egg}) {
    const auto light = make_area_light(*shape, Color(*texture));
    const Vec3 x = shape == &flat ? Vec3{0.3f, -0.2f, 0.6f} : bounds(*shape).upper * 1.3f;
    Running flux;
    Vec3 toward{0, 0, 0};
    Rng rng(1, Stream::test, 91, static_cast<std::uint64_t>(test));
    for (int i = 0; i < 40000; ++i) {
      const Vec2 u = rng.uniform2();
      flux.add(static_cast<double>(light->emit(u, rng.uniform2()).flux.r));
      if (const auto s = light->sample(x, rng.uniform2())) toward = s->wi;
    }
    const double power = static_cast<double>(light->power().r);
    EXPECT_NEAR(flux.mean(), power, 5 * flux.standard_error() + 5e-3 * power) << test;
    const Window window{x, Frame::from_normal(toward), 0.1f};
    EXPECT_GT(same_flux_p(*light, window, 52 + test), sidak(kAlpha, 3)) << test;
    ++test;
  }
}

TEST(Sun, StandsWhereTheAlmanacSays) {
  // Local noon at the equinox on the equator: in the zenith (equation of time -7.4 min then).
  SunTime t{.year = 2010,
            .month = 3,
            .day = 20,
            .hour = 12,
            .latitude = 0,
            .longitude = 0,
            .timezone = 0};
  EXPECT_NEAR(sun_position(t).zenith, 0, 0.04);
  // Midsummer at 50 degrees north: 90 - (90 - 50 + 23.44) from the zenith, due south.
  t = {.year = 2010,
       .month = 6,
       .day = 21,
       .hour = 12,
       .latitude = 50,
       .longitude = 0,
       .timezone = 0};
  EXPECT_NEAR(sun_position(t).zenith, (50 - 23.44) * std::numbers::pi / 180, 0.01);
  EXPECT_NEAR(sun_position(t).azimuth, std::numbers::pi, 0.05);
  t.hour = 6;  // in the east
  EXPECT_NEAR(sun_position(t).azimuth, std::numbers::pi / 2, 0.35);
}

TEST(Sun, IsAsBrightAsSunlight) {
  // About 1.0e5 to 1.3e5 lux outside the dust at the zenith: 683 lm/W times the 106.857 nm of the
  // observer's curve times radiance per nm and solid angle.
  const double solid_angle = 2 * std::numbers::pi * (1 - std::cos(kSunAngularRadius));
  const Rgb high = sun_radiance(0, 2), low = sun_radiance(1.4, 2);
  const double lux = 683 * 106.857 * solid_angle * static_cast<double>(luminance(high));
  EXPECT_GT(lux, 0.8e5);
  EXPECT_LT(lux, 1.4e5);
  EXPECT_LT(luminance(low), 0.5f * luminance(high));  // through more air,
  EXPECT_GT(low.r / low.b, high.r / high.b);          // and redder
}

TEST(Sky, IsBlueAndBrightAroundTheSun) {
  const SkyDirection sun{0.8, 1.0};
  const SkyModel sky(3, Rgb(0.2f), sun);
  const Rgb opposite = sky.radiance({0.8, 1.0 + std::numbers::pi});
  EXPECT_GT(opposite.b, 1.5f * opposite.r);
  EXPECT_GT(luminance(sky.radiance({0.75, 1.0})), 3 * luminance(opposite));
  EXPECT_EQ(sky.radiance({1.6, 0}), Rgb(0));  // below the horizon
  const Rgb left = sky.radiance({0.5, 1.4}), right = sky.radiance({0.5, 0.6});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(left[c], right[c], 1e-5f * left[c]);  // symmetric
}

TEST(Sky, TheSkysIlluminanceIsThatOfAClearDay) {
  const SkyModel sky(3, Rgb(0.2f), {std::numbers::pi / 4, 0});
  double y = 0;
  constexpr int n = 64;
  for (int i = 0; i < n; ++i) {
    const double zenith = (i + 0.5) / n * std::numbers::pi / 2;
    for (int j = 0; j < n; ++j) {
      const double azimuth = (j + 0.5) / n * 2 * std::numbers::pi;
      y += static_cast<double>(luminance(sky.radiance({zenith, azimuth}))) * std::sin(zenith) *
           std::cos(zenith);
    }
  }
  const double lux = 683 * 106.857 * y * std::numbers::pi * std::numbers::pi / (n * n);
  EXPECT_GT(lux, 5e3);  // clear skies give some 10 000 to 20 000 lux
  EXPECT_LT(lux, 4e4);
}

TEST(Blackbody, IsPlancksLawSeenByTheObserver) {
  // Wien's side at 555 nm, where the observer's curve is narrow: luminance is near the radiance
  // there, as both sides of it cancel to a few per cent.
  const double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23, m = 560e-9;
  const double planck = 2 * h * c * c / std::pow(m, 5) / std::expm1(h * c / (m * k * 5800)) * 1e-9;
  EXPECT_NEAR(luminance(blackbody_radiance(5800)) / planck, 1, 0.04);
  const Rgb warm = blackbody_radiance(2700), cold = blackbody_radiance(12000);
  EXPECT_GT(warm.r, 2 * warm.b);
  EXPECT_GT(cold.b, cold.r);
  const Rgb day = blackbody_radiance(6504);  // near D65, a little towards magenta
  EXPECT_NEAR(day.r / day.g, 1, 0.08);
  EXPECT_NEAR(day.b / day.g, 1, 0.08);
}

}  // namespace
}  // namespace octolux
