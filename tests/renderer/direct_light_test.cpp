// renderer/direct_light.h: light samples and BSDF sampling share direct light without loss or gain,
// whatever the kinds of light and however many samples each of them has.
#include "renderer/direct_light.h"

#include <gtest/gtest.h>

#include "renderer/glance.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// A metal plate that mirrors the place of the sun, under sun and sky.
std::unique_ptr<Scene> plate(double alpha, const std::string& emitters) {
  return scene_from("<scene version='3.0.0'>" + sensor_xml("0, 3, 4", "0, 0, 0", 1, 2, 2) +
                    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='-90'/>"
                    "</transform><bsdf type='roughconductor'><float name='alpha' value='" +
                    std::to_string(alpha) + "'/></bsdf></shape>" + emitters + "</scene>");
}

const std::string kSunAndSky =
    "<emitter type='sunsky'><vector name='sun_direction' x='0.1' y='3' z='-4'/>"
    "<float name='sun_radius_scale' value='6'/></emitter>";

class DirectLight : public testing::TestWithParam<std::pair<double, LightSamples>> {
 protected:
  /// Luminance from the plate, found by so many light samples and one BSDF sample.
  static Running seen(const Scene& scene, LightSamples samples, int draws) {
    const LightSampler lights(scene);
    const DirectStrategy strategy{Lobes::non_delta, Lobes::all, samples, 1, 8};
    Running mean;
    for (int i = 0; i < draws; ++i) {
      Tracer tracer(scene, Rng(1, Stream::test, 910, static_cast<std::uint64_t>(i)));
      const Ray ray = random_eye_ray(scene, tracer.rng);
      Rgb weight(1);
      int segments = 0;
      const auto hit = tracer.next(ray, weight, segments);
      const Scattering at(hit->point, *hit->bsdf, -ray.direction, Carried::radiance);
      Rgb sum(0);
      if (samples.any()) {
        sum = sample_lights(tracer, lights, at, receiver(at), strategy, {samples, tracer.rng});
      }
      if (const auto s = at.sample(tracer.rng.uniform(), tracer.rng.uniform2(), Lobes::all)) {
        const Arrival arrival{receiver(at), s->pdf_w, 1, samples};
        sum += s->weight * environment(scene, lights, s->wi, arrival);
      }
      mean.add(static_cast<double>(luminance(sum)));
    }
    return mean;
  }
};

TEST_P(DirectLight, IsSharedWithoutLossOrGain) {
  const auto [alpha, samples] = GetParam();
  const auto scene = plate(alpha, kSunAndSky);
  ASSERT_EQ(scene->environment.size(), 2u);
  const Running alone = seen(*scene, {}, 400'000), shared = seen(*scene, samples, 100'000);
  const double variance = alone.variance_of_mean() + shared.variance_of_mean();
  EXPECT_LT(std::sqrt(variance), 0.02 * alone.mean());
  EXPECT_GT(z_test_p((shared.mean() - alone.mean()) / std::sqrt(variance)), sidak(kAlpha, 4))
      << shared.mean() << " instead of " << alone.mean();
}

INSTANTIATE_TEST_SUITE_P(Plates, DirectLight,
                         testing::Values(std::pair{0.02, LightSamples{1, 1}},
                                         std::pair{0.02, LightSamples{1, 5}},
                                         std::pair{0.02, LightSamples{5, 1}},
                                         std::pair{0.2, LightSamples{2, 2}}));

}  // namespace
}  // namespace octolux::test
