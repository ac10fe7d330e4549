// renderer/gather_guide.h: the guide's density is what it samples, and gather rays with a guide
// bring the same radiance in the mean as without.
#include "renderer/gather_guide.h"

#include <gtest/gtest.h>

#include "core/bsdf_makers.h"
#include "core/sampling.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

constexpr Vec3 kNormal{0, 0, 1};

Photon photon(Vec3 wi, float flux, int segments) {
  return {{0.1f * wi.x, 0.1f * wi.y, 0},
          normalize(wi),
          kNormal,
          Rgb(flux),
          segments,
          0,
          kNormal,
          segments > 1};
}

struct Case {
  const char* name;
  std::vector<Photon> photons;
};

std::vector<Photon> spread(int count) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Rng rng(7, Stream::test, 0, static_cast<std::uint64_t>(i));
    const Vec3 wi = sample_cosine_hemisphere(rng.uniform2());
    photons.push_back(photon(wi, 0.1f + rng.uniform(), 2));
  }
  return photons;
}

std::vector<Case> cases() {
  const Vec3 slant{0.6f, 0, 0.8f};
  return {
      {"one", {photon(slant, 1, 2)}},
      {"coinciding", {photon(slant, 1, 2), photon(slant, 3, 5), photon(slant, 1, 2)}},
      {"two clusters",
       {photon({0.60f, 0, 0.8f}, 1, 2), photon({0.61f, 0.01f, 0.79f}, 1, 2),
        photon({0.60f, 0.02f, 0.8f}, 1, 2), photon({-1, 0, 0.1f}, 9, 3),
        photon({-1, 0.1f, 0.1f}, 9, 3)}},
      {"spread", spread(20)},
      {"more than lobes", spread(100)},
  };
}

GatherGuide guide(const std::vector<Photon>& photons) {
  const PhotonMap map(photons);
  NeighbourBuffer buffer;
  const PhotonQuery query{.position = {0, 0, 0}, .normal = kNormal};
  return {map, map.nearest(query, photons.size(), buffer), kNormal};
}

/// Of a cell where photons arrive as in the case, as often as it has room for them.
LearnedGuide learned(const std::vector<Photon>& photons) {
  std::vector<Photon> many;
  while (many.size() + photons.size() <= 512) {
    many.insert(many.end(), photons.begin(), photons.end());
  }
  LearnedGuides guides;
  guides.add(many);
  guides.build();
  return *guides.find({0, 0, 0}, kNormal);
}

/// The cell of a grid equal in area to which `w` belongs.
std::size_t cell(Vec3 w) {
  const auto row = static_cast<std::size_t>(std::clamp((1 - w.z) * 16, 0.0f, 31.0f));
  const float turn = std::atan2(w.y, w.x) / (2 * kPi) + 0.5f;
  return row * 64 + static_cast<std::size_t>(std::clamp(turn * 64, 0.0f, 63.0f));
}

TEST(GatherGuide, DensityIsThatOfTheSamples) {
  constexpr int kSamples = 200000;
  constexpr int kFine = 32;  // integration steps a cell and axis
  const std::vector<Case> all = cases();
  for (const Case& c : all) {
    const GatherGuide g = guide(c.photons);
    std::vector<double> observed(32 * 64), expected(32 * 64);
    for (int i = 0; i < kSamples; ++i) {
      Rng rng(8, Stream::test, 0, static_cast<std::uint64_t>(i));
      ++observed[cell(g.sample(rng.uniform2()))];
    }
    double integral = 0;
    for (int i = 0; i < 32 * kFine; ++i) {
      for (int j = 0; j < 64 * kFine; ++j) {
        const Vec3 w = sample_sphere({(i + 0.5f) / (32 * kFine), (j + 0.5f) / (64 * kFine)});
        const double p = g.pdf_w(w) * 4 * kPi / (32 * kFine * 64 * kFine);
        expected[cell(w)] += p * kSamples;
        integral += p;
      }
    }
    EXPECT_NEAR(integral, 1, 2e-3) << c.name;  // midpoint rule over lobes of 2.6 degrees
    EXPECT_GT(chi2_test_p(observed, expected), sidak(kAlpha, static_cast<double>(all.size())))
        << c.name;
  }
}

TEST(GatherGuide, ListensOnlyToScatteredPhotonsWithFlux) {
  EXPECT_EQ(guide({photon({0, 0, 1}, 1, 1), photon({1, 0, 1}, 0, 2)}).pdf_w({0, 0, 1}), 0);
  EXPECT_GT(guide({photon({0, 0, 1}, 1, 1), photon({1, 0, 1}, 1, 2)}).pdf_w({0, 0, 1}), 0);
}

TEST(GatherGuide, KnowsUnevenLight) {
  EXPECT_EQ(GatherGuide().unevenness(), 1);
  EXPECT_EQ(guide({photon({0, 0, 1}, 1, 2)}).unevenness(), kInfinity);
  // Drawn by the cosine, of equal flux: 1, were the lobes not blurred and noisy.
  std::vector<Photon> even = spread(32);
  for (Photon& p : even) p.flux = Rgb(1);
  EXPECT_GT(guide(even).unevenness(), 0.5f);
  EXPECT_LT(guide(even).unevenness(), 2);
  // Photons that agree: a lobe of 2.6 degrees against a cosine.
  EXPECT_GT(guide(cases()[1].photons).unevenness(), 100);
  // One far off the others says nothing for them, nor they for it.
  const float apart = guide({photon({1, 0, 0.2f}, 1, 2), photon({-1, 0, 0.2f}, 1, 2)}).unevenness();
  EXPECT_LT(apart, 1);
}

double half_bright(Vec3 wi) { return wi.x > 0.5f ? 5 : 0.2; }
constexpr Vec3 kLamp{0.8f, 0, 0.6f};
double small_lamp(Vec3 wi) { return dot(wi, kLamp) > 0.99f ? 100 : 0.2; }

std::vector<Photon> from_lamp(int count) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Rng rng(10, Stream::test, 0, static_cast<std::uint64_t>(i));
    const Vec2 d = sample_disk(rng.uniform2()) * 0.14f;
    photons.push_back(photon(kLamp + Frame::from_normal(kLamp).to_world({d.x, d.y, 0}), 1, 2));
  }
  return photons;
}

/// Sums of weights times radiance, one for each of many sets of rays.
Running reflected(const Bsdf& bsdf, const GuidePair& guides, int rays, double (*radiance)(Vec3)) {
  SurfacePoint point;
  point.ng = point.ns = kNormal;
  const Scattering at(point, bsdf, normalize({0.5f, 0.2f, 0.6f}), Carried::radiance);
  Running sum;
  for (int i = 0; i < 20000; ++i) {
    Rng rng(9, Stream::test, 0, static_cast<std::uint64_t>(i));
    const PointSet by_bsdf(rays, rng), by_guide(rays, rng);
    const GatherDirections directions(at, guides, rays, {by_bsdf, by_guide});
    double total = 0;
    for (int r = 0; r < rays; ++r) {
      const std::optional<GatherDirection> d = directions.draw(r, rng);
      if (d) total += d->weight.r * radiance(d->wi);
    }
    sum.add(total);
  }
  return sum;
}

TEST(GatherDirections, GuidesChangeNoMean) {
  const auto diffuse = make_diffuse(Rgb(0.7f));
  const auto rough = make_rough_conductor({{}, MicrofacetKind::ggx, 0.4f, 0.4f});
  const std::vector<Case> all = cases();
  const GatherGuide nothing{};
  for (const Bsdf* bsdf : {diffuse.get(), rough.get()}) {
    for (const int rays : {1, 2, 5, 8}) {
      const Running truth = reflected(*bsdf, {nothing, nullptr}, rays, half_bright);
      for (const Case& c : all) {
        const GatherGuide nearby = guide(c.photons);
        const LearnedGuide before = learned(c.photons);
        for (const GuidePair& pair : {GuidePair(nearby, nullptr), GuidePair(nothing, &before),
                                      GuidePair(nearby, &before)}) {
          const Running guided = reflected(*bsdf, pair, rays, half_bright);
          const double error = std::hypot(guided.standard_error(), truth.standard_error());
          EXPECT_GT(z_test_p((guided.mean() - truth.mean()) / error), sidak(kAlpha, 120))
              << c.name << ", " << rays << " rays";
        }
      }
    }
  }
}

TEST(GatherDirections, GuidesToASmallLampLowerVariance) {
  const auto diffuse = make_diffuse(Rgb(0.7f));
  const GatherGuide nothing{}, nearby = guide(from_lamp(40));
  const LearnedGuide before = learned(from_lamp(500));
  const double plain = reflected(*diffuse, {nothing, nullptr}, 8, small_lamp).variance();
  EXPECT_LT(reflected(*diffuse, {nearby, nullptr}, 8, small_lamp).variance(), plain / 2);
  EXPECT_LT(reflected(*diffuse, {nothing, &before}, 8, small_lamp).variance(), plain / 2);
  EXPECT_LT(reflected(*diffuse, {nearby, &before}, 8, small_lamp).variance(), plain / 2);
}

TEST(GuidePair, FollowsWhoKnows) {
  const GatherGuide none{}, lamp = guide(from_lamp(40));
  const LearnedGuide even = learned(spread(500)), learned_lamp = learned(from_lamp(500));
  EXPECT_TRUE(GuidePair(none, nullptr).empty());
  EXPECT_TRUE(GuidePair(none, &even).empty());
  EXPECT_EQ(GuidePair(lamp, &even).pdf_w(kLamp), lamp.pdf_w(kLamp));
  EXPECT_EQ(GuidePair(none, &learned_lamp).pdf_w(kLamp), learned_lamp.pdf_w(kLamp));
  // A single photon has nobody to confirm it.
  const GatherGuide single = guide(from_lamp(1));
  EXPECT_EQ(GuidePair(single, nullptr).pdf_w(kLamp), single.pdf_w(kLamp));
  EXPECT_EQ(GuidePair(single, &learned_lamp).pdf_w(kLamp), learned_lamp.pdf_w(kLamp));
  // Both know: each by how well.
  const GuidePair both(lamp, &learned_lamp);
  const float to_lamp = lamp.unevenness(), to_learned = learned_lamp.unevenness();
  EXPECT_NEAR(both.pdf_w(kLamp) * (to_lamp + to_learned),
              lamp.pdf_w(kLamp) * to_lamp + learned_lamp.pdf_w(kLamp) * to_learned,
              1e-4 * both.pdf_w(kLamp) * (to_lamp + to_learned));
}

}  // namespace
}  // namespace octolux::test
