// Disc and cone at edges, against closed forms.
#include <gtest/gtest.h>

#include "tests/estimators/lookups.h"
#include "tests/stats.h"

namespace octolux {
namespace {

/// Part of a kernel's integral over the unit disc that lies in x > -d. `profile(r)`: the kernel at
/// a distance, of integral 1.
template <class Profile>
double kept(double d, Profile profile) {
  constexpr int kSteps = 4000;
  double total = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = (i + 0.5) / kSteps;
    const double open = r <= d ? 2 * std::numbers::pi : 2 * (std::numbers::pi - std::acos(d / r));
    total += open * r * profile(r) / kSteps;
  }
  return total;
}

double disc_profile(double) { return 1 / std::numbers::pi; }
double cone_profile(double r) { return 3 * (1 - r) / std::numbers::pi; }

TEST(Radial, FixedRadiusAtAnEdgeKeepsTheKernelsPart) {
  constexpr int kRuns = 3000;
  for (const double distance : {0.0, 0.3, 0.8}) {
    test::Running disc, cone;
    const LabWorld world(find_lab_case("wall").layout(distance * 0.5, 0), 20);
    const double density = 48 / near_flux(find_lab_case("wall").layout(distance * 0.5, 0), 1);
    for (int run = 0; run < kRuns; ++run) {
      Rng rng(1, Stream::test, 0, static_cast<std::uint64_t>(run));
      test::Lookup lookup;
      lookup.photons = world.photons(47, PhotonPattern::poisson, rng);
      for (Photon& p : lookup.photons) p.flux = Rgb(static_cast<float>(1 / density));
      lookup.bandwidth.max_radius = 0.5f;
      EstimatorConfig config;
      config.neighbours = 2000;
      config.kernel = "disc";
      disc.add(lookup(config).radiance.g);
      config.kernel = "cone";
      cone.add(lookup(config).radiance.g);
    }
    const double alpha = test::sidak(test::kAlpha, 6);
    EXPECT_GT(test::z_test_p(disc.z(kept(distance, disc_profile))), alpha) << distance;
    EXPECT_GT(test::z_test_p(cone.z(kept(distance, cone_profile))), alpha) << distance;
  }
}

/// With a bandwidth from the photons themselves the share is that of the free angle, exactly.
TEST(Radial, NearestPhotonsAtWallAndCornerSeeTheFreeAngle) {
  LabSettings settings;
  settings.kernels = {parse_lab_kernel("disc"), parse_lab_kernel("cone")};
  settings.neighbours = {10, 50};
  const std::vector<std::pair<const char*, double>> places{
      {"wall", 0.5}, {"corner", 0.25}, {"reentrant", 0.75}};
  for (const auto& [name, share] : places) {
    for (const LabResult& r : measure(find_lab_case(name).layout(0, 0), settings)) {
      EXPECT_GT(test::z_test_p((r.mean - share) / r.standard_error), test::sidak(test::kAlpha, 12))
          << name << " " << r.kernel << " " << r.neighbours;
    }
  }
}

/// Published: n photons over the disc of the nth reads n / (n - 1) too bright.
TEST(Radial, PublishedDiscIsTooBright) {
  LabSettings settings;
  settings.kernels = {parse_lab_kernel("disc:published")};
  settings.neighbours = {5, 10, 50};
  settings.runs = 8000;
  for (const LabResult& r : measure(find_lab_case("plane").layout(0, 0), settings)) {
    const double expected = r.neighbours / (r.neighbours - 1.0);
    EXPECT_GT(test::z_test_p((r.mean - expected) / r.standard_error), test::sidak(test::kAlpha, 3))
        << r.neighbours << ": " << r.mean;
  }
}

}  // namespace
}  // namespace octolux
