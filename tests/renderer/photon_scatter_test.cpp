// Photons from outside: aimed or not, they carry the same flux in every direction, and those that
// reach the focus are light.
#include "renderer/photon_scatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/bsdf_makers.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

constexpr float kReflectance = 0.6f;

/// A photon of 1 W on the ground at the origin.
struct Ground {
  std::unique_ptr<Bsdf> bsdf = make_diffuse(Color(Rgb(kReflectance)));
  SurfacePoint point;

  Ground() { point.ng = point.ns = {0, 0, 1}; }

  std::optional<Flight> scattered(const std::optional<Focus>& focus, Rng& rng) const {
    const Scattering at(point, *bsdf, normalize(Vec3{0.3f, -0.2f, 0.9f}), Carried::flux);
    Flight flight{{}, Rgb(1)};
    if (!scatter(flight, at, Lobes::all, focus, rng)) return std::nullopt;
    EXPECT_TRUE(flight.scattered);
    return flight;
  }
};

/// The focus as the origin sees it, at 10 m, its target of 1.5 radii under asin(1.5 r / 10).
Focus focus_of(float radius) { return {normalize(Vec3{0.6f, 0.2f, 0.5f}) * 10, radius}; }

TEST(PhotonScatter, FluxDoesNotDependOnTheFocus) {
  const Ground ground;
  constexpr int kPhotons = 200'000;
  const double alpha = sidak(kAlpha, 3 * 3);
  std::uint64_t test = 0;
  for (const float radius : {1.5f, 0.1f, 0.001f}) {
    const Focus focus = focus_of(radius);
    const Vec3 axis = focus.center / 10;
    const double sine = 0.15 * static_cast<double>(radius);
    Running all, inside, around;
    Rng rng(1, Stream::test, 310, test++);
    for (int i = 0; i < kPhotons; ++i) {
      const std::optional<Flight> f = ground.scattered(focus, rng);
      const double flux = f ? static_cast<double>(f->flux.g) : 0;
      const double off = f ? static_cast<double>(length(cross(axis, f->ray.direction))) : 2;
      const bool ahead = f && dot(axis, f->ray.direction) > 0;
      all.add(flux);
      inside.add(ahead && off < sine ? flux : 0);
      around.add(ahead && off < 0.3 ? flux : 0);
    }
    // A cone of half angle a about a direction at cosine c to the normal, all above the ground,
    // receives sin^2 a c of what a diffuse surface scatters.
    const auto share = [&](double s) {
      return static_cast<double>(kReflectance) * s * s * static_cast<double>(axis.z);
    };
    EXPECT_GT(z_test_p(all.z(static_cast<double>(kReflectance))), alpha) << radius;
    EXPECT_GT(z_test_p(inside.z(share(sine))), alpha) << radius << ": " << inside.mean();
    EXPECT_GT(z_test_p(around.z(share(0.3))), alpha) << radius << ": " << around.mean();
    EXPECT_LT(inside.standard_error(), 0.01 * inside.mean()) << radius;
  }
}

/// However far away the focus: flux into the target goes as its solid angle, and no photon has more
/// than if none were aimed and the others had their share.
TEST(PhotonScatter, NoPhotonThatMeetsTheFocusIsHeavy) {
  const Ground ground;
  for (const float radius : {1.5f, 1e-2f, 1e-4f, 1e-6f}) {
    const Focus focus = focus_of(radius);
    const double sine = 0.15 * static_cast<double>(radius);
    const double solid_angle = std::numbers::pi * sine * sine;
    Rng rng(1, Stream::test, 311, 0);
    int met = 0;
    for (int i = 0; i < 20'000; ++i) {
      const std::optional<Flight> f = ground.scattered(focus, rng);
      if (!f) continue;
      EXPECT_LE(f->flux.g, 1.001f);  // roulette keeps flux
      const double off = static_cast<double>(length(cross(focus.center / 10, f->ray.direction)));
      if (off > 0.9 * sine || dot(focus.center, f->ray.direction) < 0) continue;
      ++met;
      EXPECT_LE(static_cast<double>(f->flux.g), 4 * solid_angle / std::numbers::pi * 1.2) << radius;
    }
    EXPECT_GT(met, 3000) << radius;
  }
}

TEST(PhotonScatter, NearTheFocusAndOnMirrorsNothingIsAimed) {
  const Ground ground;
  const auto mirror = make_conductor({.eta = Rgb(0.2f), .k = Rgb(4)});
  const Focus near = focus_of(4.5f), far = focus_of(0.1f);
  for (int i = 0; i < 1000; ++i) {
    Rng with(1, Stream::test, 312, static_cast<std::uint64_t>(i)), without = with;
    const std::optional<Flight> a = ground.scattered(near, with);
    const std::optional<Flight> b = ground.scattered(std::nullopt, without);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_EQ(a->ray.direction, b->ray.direction);
    }

    const Scattering at(ground.point, *mirror, normalize(Vec3{0.3f, -0.2f, 0.9f}), Carried::flux);
    Flight reflected{{}, Rgb(1)};
    if (!scatter(reflected, at, Lobes::all, far, with)) continue;
    EXPECT_FALSE(reflected.scattered);
    EXPECT_NEAR(dot(reflected.ray.direction, Vec3{-0.3f, 0.2f, 0.9f}),
                length(Vec3{0.3f, 0.2f, 0.9f}), 1e-5);
  }
}

}  // namespace
}  // namespace octolux::test
