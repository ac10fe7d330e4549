// renderer/gather_directions.h: gather rays with a guide bring the same radiance in the mean as
// without, and less noise where it knows.
#include "renderer/gather_directions.h"

#include <gtest/gtest.h>

#include "core/bsdf_makers.h"
#include "core/sampling.h"
#include "tests/stats.h"

namespace octolux::test {
namespace {

constexpr Vec3 kNormal{0, 0, 1};
constexpr Vec3 kLamp{0.8f, 0, 0.6f};

double half_bright(Vec3 wi) { return wi.x > 0.5f ? 5 : 0.2; }
double small_lamp(Vec3 wi) { return dot(wi, kLamp) > 0.99f ? 100 : 0.2; }

/// A lobe at the lamp, a wide one, one on the horizon and one below it.
LobeMixture guide() {
  LobeMixture lobes;
  lobes.add(kLamp, 200, 0.4f);
  lobes.add({-0.6f, 0, 0.8f}, 1, 0.4f);
  lobes.add({0, 1, 0}, 30, 0.1f);
  lobes.add({0, 0.6f, -0.8f}, 2, 0.1f);
  return lobes;
}

/// Sums of weights times radiance, one for each of many sets of rays.
Running reflected(const Bsdf& bsdf, const LobeMixture& lobes, int rays, double (*radiance)(Vec3)) {
  SurfacePoint point;
  point.ng = point.ns = kNormal;
  const Scattering at(point, bsdf, normalize({0.5f, 0.2f, 0.6f}), Carried::radiance);
  Running sum;
  for (int i = 0; i < 200'000; ++i) {
    Rng rng(9, Stream::test, 0, static_cast<std::uint64_t>(i));
    const PointSet by_bsdf(rays, rng), by_guide(rays, rng);
    const GatherDirections directions(at, lobes, rays, {by_bsdf, by_guide});
    double total = 0;
    for (int r = 0; r < rays; ++r) {
      const std::optional<GatherDirection> d = directions.draw(r, rng);
      if (d) total += d->weight.r * radiance(d->wi);
    }
    sum.add(total);
  }
  return sum;
}

TEST(GatherDirections, AGuideChangesNoMean) {
  const auto diffuse = make_diffuse(Rgb(0.7f));
  const auto rough = make_rough_conductor({{}, MicrofacetKind::ggx, 0.4f, 0.4f});
  for (const Bsdf* bsdf : {diffuse.get(), rough.get()}) {
    for (const auto radiance : {half_bright, small_lamp}) {
      for (const int rays : {1, 2, 5, 8}) {
        const Running truth = reflected(*bsdf, {}, rays, radiance);
        const Running guided = reflected(*bsdf, guide(), rays, radiance);
        const double error = std::hypot(guided.standard_error(), truth.standard_error());
        EXPECT_GT(z_test_p((guided.mean() - truth.mean()) / error), sidak(kAlpha, 16))
            << rays << " rays";
      }
    }
  }
}

TEST(GatherDirections, AGuideToASmallLampLowersVariance) {
  const auto diffuse = make_diffuse(Rgb(0.7f));
  const double plain = reflected(*diffuse, {}, 8, small_lamp).variance();
  EXPECT_LT(reflected(*diffuse, guide(), 8, small_lamp).variance(), plain / 8);
}

TEST(GatherDirections, HalfOfTheRaysFollowAGuide) {
  EXPECT_EQ(GatherDirections::guided({}, 8), 0);
  EXPECT_EQ(GatherDirections::guided(guide(), 8), 4);
  EXPECT_EQ(GatherDirections::guided(guide(), 1), 0);
}

}  // namespace
}  // namespace octolux::test
