// What every kernel of list.def must do, with every option: a new line there is tested by this file
// as it stands.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "tests/estimators/lookups.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using test::all_configs;
using test::describe;
using test::Lookup;
using test::photon_at;
using test::uniform_photons;

EstimatorConfig with_neighbours(EstimatorConfig config, int neighbours) {
  config.neighbours = neighbours;
  return config;
}

/// Largest relative difference of two estimates' radiance.
double difference(const Estimate& a, const Estimate& b) {
  return std::abs(a.radiance.g - b.radiance.g) / std::max(b.radiance.g, 1e-30f);
}

bool is_usable(const Estimate& e) {
  return is_finite(e.radiance) && e.radiance.r >= 0 && e.radiance.g >= 0 && e.radiance.b >= 0 &&
         std::isfinite(e.bandwidth) && e.bandwidth >= 0 && std::isfinite(e.area) && e.area >= 0 &&
         e.count >= 0;
}

// Rounding moves a photon by 2^-24 of its distance from the origin (10 bandwidths at most here) per
// operation, of which there are fewer than 20 between the photon and its place in the query's
// plane. Principal axes amplify that by at most the inverse of their anisotropy, above 0.02 here.
constexpr double kPlacing = 20 * 10 * 0x1p-24 / 0.02;

TEST(AllEstimators, OpenPlaneIsUnbiased) {
  std::vector<LabKernel> kernels;
  for (const EstimatorConfig& config : all_configs()) {
    if (config.correction) kernels.push_back({describe(config), config});
  }
  LabSettings settings;
  settings.kernels = kernels;
  settings.neighbours = {5, 10, 20, 50, 200};
  settings.runs = 1500;
  for (const double shrink : {1.0, 0.5}) {
    settings.shrink = shrink;
    const auto results = measure(find_lab_case("plane").layout(0, 0), settings);
    const double alpha = test::sidak(test::kAlpha, 2.0 * static_cast<double>(results.size()));
    for (const LabResult& r : results) {
      EXPECT_GT(test::z_test_p(r.bias() / r.standard_error), alpha)
          << r.kernel << " " << r.neighbours << " shrink " << shrink << ": " << r.bias();
    }
  }
}

TEST(AllEstimators, FixedRadiusIsUnbiased) {
  // The radius is the limit at every look-up: photons are Poisson distributed, 12 on average.
  constexpr int kRuns = 1500;
  const std::vector<EstimatorConfig> configs = all_configs();
  const LabWorld world(find_lab_case("plane").layout(0, 0), 0);
  std::vector<test::Running> runs(configs.size());
  for (int run = 0; run < kRuns; ++run) {
    Rng rng(3, Stream::test, 0, static_cast<std::uint64_t>(run));
    Lookup lookup;
    lookup.photons = world.photons(47, PhotonPattern::poisson, rng);  // 48 within a distance of 1
    lookup.bandwidth.max_radius = 0.5f;
    for (std::size_t i = 0; i < configs.size(); ++i) {
      if (configs[i].correction) {
        runs[i].add(lookup(with_neighbours(configs[i], 2000)).radiance.g);
      }
    }
  }
  for (std::size_t i = 0; i < configs.size(); ++i) {
    if (!configs[i].correction) continue;
    EXPECT_GT(test::z_test_p(runs[i].z(1)), test::sidak(test::kAlpha, configs.size()))
        << describe(configs[i]) << ": " << runs[i].mean();
  }
}

TEST(AllEstimators, LinearInFlux) {
  Lookup lookup;
  lookup.photons = uniform_photons(400, 1, 1);
  for (const EstimatorConfig& config : all_configs()) {
    const Estimate base = lookup(config);
    Lookup brighter = lookup;
    for (Photon& p : brighter.photons) p.flux = p.flux * 3.0f;
    // Packed flux has 18 bits, twice.
    EXPECT_NEAR(brighter(config).radiance.g / base.radiance.g, 3, 3 * 2 * 0x1p-17)
        << describe(config);
    Lookup only_red = lookup;
    for (Photon& p : only_red.photons) p.flux = {1, 0, 0};
    EXPECT_EQ(only_red(config).radiance.r, base.radiance.r) << describe(config);
    EXPECT_EQ(only_red(config).radiance.g, 0) << describe(config);
  }
}

TEST(AllEstimators, InvariantUnderTranslationAndRotation) {
  for (int seed = 1; seed <= 5; ++seed) {
    Lookup lookup;
    lookup.photons = uniform_photons(400, 1, static_cast<std::uint64_t>(seed));
    // About the normal, so that the frame in which a kernel works turns against the photons; then
    // everything is moved. Published boxes stand along the frame's axes on purpose.
    Lookup moved = lookup;
    const Vec3 shift{3, -2, 1};
    const float c = std::cos(0.7f), s = std::sin(0.7f);
    for (Photon& p : moved.photons) {
      const Vec3 q = p.position;
      p.position = Vec3{c * q.x - s * q.y, s * q.x + c * q.y, q.z} + shift;
    }
    moved.position = lookup.position + shift;
    for (const EstimatorConfig& config : all_configs()) {
      if (!config.correction && config.kernel == "octobox") continue;
      if (config.kernel == "feeler" || config.kernel == "region") continue;  // their rays turn
      EXPECT_LT(difference(moved(config), lookup(config)), kPlacing) << describe(config);
    }
  }
}

TEST(AllEstimators, InvariantUnderTippingTheSurface) {
  Lookup lookup;
  lookup.photons = uniform_photons(400, 1, 7);
  Lookup tipped = lookup;
  tipped.normal = normalize(Vec3{0.3f, -0.4f, 0.8f});
  const Frame from = Frame::from_normal({0, 0, 1}), to = Frame::from_normal(tipped.normal);
  for (Photon& p : tipped.photons) {
    p.position = to.to_world(from.to_local(p.position));
    p.normal = p.wi = tipped.normal;
  }
  for (const EstimatorConfig& config : all_configs()) {
    EXPECT_LT(difference(tipped(config), lookup(config)), kPlacing) << describe(config);
  }
}

TEST(AllEstimators, ExactUnderPowersOfTwo) {
  Lookup lookup;
  lookup.photons = uniform_photons(400, 1, 2);
  for (const int power : {-12, 9}) {
    Lookup scaled = lookup;
    scaled.floor = std::ldexp(lookup.floor, power);
    for (Photon& p : scaled.photons) {
      p.position = p.position * std::ldexp(1.0f, power);
      p.flux = p.flux * 8.0f;
    }
    for (const EstimatorConfig& config : all_configs()) {
      const Estimate a = lookup(config), b = scaled(config);
      EXPECT_EQ(b.radiance.g, std::ldexp(a.radiance.g, 3 - 2 * power)) << describe(config);
      EXPECT_EQ(b.count, a.count) << describe(config);
    }
  }
}

TEST(AllEstimators, IndependentOfPhotonOrder) {
  Lookup lookup;
  lookup.photons = uniform_photons(400, 1, 3);
  Lookup reversed = lookup;
  std::reverse(reversed.photons.begin(), reversed.photons.end());
  for (const EstimatorConfig& config : all_configs()) {
    // Sums of 50 terms, of coordinates and of flux, in another order.
    EXPECT_LT(difference(reversed(config), lookup(config)), 50 * 0x1p-23 / 0.02)
        << describe(config);
  }
}

/// Photons that no distribution would make, but a scene might. The last set's powers span twelve
/// decades.
std::vector<std::vector<Photon>> awkward_sets() {
  std::vector<std::vector<Photon>> sets(2);
  sets[1] = {photon_at({0.5f, 0.2f, 0})};
  sets.push_back({photon_at({0, 0, 0})});
  sets.push_back({photon_at({0, 0, 0}), photon_at({0.5f, 0.2f, 0})});
  sets.emplace_back(100, photon_at({0.5f, 0.25f, 0}));
  sets.emplace_back(100, photon_at({0, 0, 0}));
  std::vector<Photon> line, through, clusters, ring, powers, grid;
  Rng rng(5, Stream::test, 0, 0);
  for (int i = 0; i < 120; ++i) {
    const float u = rng.uniform();
    const float x = 2 * u - 1, angle = static_cast<float>(i);
    line.push_back(photon_at({x, 0.3f * x + 0.1f, 0}));
    through.push_back(photon_at({x, 0, 0}));
    clusters.push_back(photon_at(i % 2 == 0 ? Vec3{0.5f, 0, 0} : Vec3{-0.3f, 0.4f, 0}));
    ring.push_back(photon_at({std::cos(angle), std::sin(angle), 0}));
    powers.push_back(photon_at({x, std::sin(31 * angle), 0},
                               Rgb(std::pow(10.0f, static_cast<float>(i % 13) - 6))));
    grid.push_back(photon_at({static_cast<float>(i % 11) - 5, static_cast<float>(i / 11) - 5, 0}));
  }
  grid.push_back(photon_at({0, 0, 0}));
  for (const auto& set : {line, through, clusters, ring, grid, powers}) sets.push_back(set);
  return sets;
}

TEST(AllEstimators, AwkwardPhotonsGiveFiniteAnswers) {
  const std::vector<std::vector<Photon>> sets = awkward_sets();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const float scale : {1e-25f, 1e-18f, 1e-4f, 1.0f, 1e4f, 1e17f}) {
      Lookup lookup;
      lookup.photons = sets[i];
      lookup.floor = 100 * scale;
      for (Photon& p : lookup.photons) p.position = p.position * scale;
      for (const EstimatorConfig& config : all_configs()) {
        for (const int n : {1, 2, 3, 8, 50, 200}) {
          for (const float shrink : {1.0f, 0.3f}) {
            lookup.bandwidth.shrink = shrink;
            const Estimate e = lookup(with_neighbours(config, n));
            EXPECT_TRUE(is_usable(e)) << describe(with_neighbours(config, n)) << " set " << i
                                      << " scale " << scale << ": " << e.radiance.g;
          }
        }
      }
    }
  }
}

TEST(AllEstimators, RandomConfigurationsGiveFiniteAnswers) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed, Stream::test, 1, 0);
    Lookup lookup;
    const int count = 1 + static_cast<int>(120 * rng.uniform());
    const float flatness = std::pow(10.0f, -8 * rng.uniform());
    for (int i = 0; i < count; ++i) {
      const Vec2 u = rng.uniform2();
      const Vec2 v = rng.uniform2();
      Photon p = photon_at({u.x - 0.5f, flatness * (u.y - 0.5f), 0.01f * v.x});
      p.normal = normalize(Vec3{v.x - 0.5f, v.y - 0.5f, 1});
      p.flux = Rgb(std::pow(10.0f, 12 * v.y - 6));
      lookup.photons.push_back(p);
    }
    lookup.bandwidth.shrink = 0.2f + 0.8f * rng.uniform();
    const int n = 1 + static_cast<int>(99 * rng.uniform());
    for (const EstimatorConfig& config : all_configs()) {
      EXPECT_TRUE(is_usable(lookup(with_neighbours(config, n))))
          << describe(with_neighbours(config, n)) << " seed " << seed;
    }
  }
}

TEST(AllEstimators, BrokenPhotonsAreRejectedAndCounted) {
  std::vector<Photon> photons = uniform_photons(100, 1, 4);
  photons[3].position.x = std::numeric_limits<float>::quiet_NaN();
  photons[50].flux.g = kInfinity;
  photons[70].wi.z = -kInfinity;
  EXPECT_EQ(PhotonMap(photons).rejected(), 3u);
  for (const EstimatorConfig& config : all_configs()) {
    Lookup lookup;
    lookup.photons = photons;
    EXPECT_TRUE(is_usable(lookup(config))) << describe(config);
  }
}

TEST(AllEstimators, GrazingNormalsDoNotCount) {
  Lookup lookup;
  lookup.photons = uniform_photons(200, 1, 6);
  for (Photon& p : lookup.photons) p.normal = p.wi = normalize(Vec3{1, 0, 1e-3f});
  for (const EstimatorConfig& config : all_configs()) {
    EXPECT_EQ(lookup(config).radiance.g, 0) << describe(config);
  }
}

TEST(AllEstimators, WrongSettingsAreNamed) {
  const auto message = [](EstimatorConfig config) {
    try {
      make_estimator(config);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EstimatorConfig config;
  config.octants = "nine";
  EXPECT_NE(message(config).find("auto, eight, one"), std::string::npos) << message(config);
  config = {};
  config.kernel = "octbox";
  EXPECT_NE(message(config).find("did you mean 'octobox'"), std::string::npos) << message(config);
  EXPECT_NE(message(with_neighbours({}, 0)).find("neighbours"), std::string::npos);
}

}  // namespace
}  // namespace octolux
