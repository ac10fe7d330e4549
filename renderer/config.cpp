// The ranges of the settings.
#include "renderer/config.h"

#include <algorithm>
#include <string>

#include "core/error.h"

namespace octolux {

namespace {

void require(bool ok, const std::string& message) {
  if (!ok) throw Error(message);
}

// Chosen by error at equal time, tools/bench/README.md: more eye samples average less noise of
// photons and fewer passes shrink the bandwidth less, so scenes with few photons lose by more.
constexpr std::int64_t kEyeSamplesPerPhoton = 3, kMostEyeSamples = 4;

/// At most `wanted`, and a divisor of `samples` if that many are asked for, so that whole passes
/// are exactly so many.
std::int64_t dividing(std::int64_t wanted, std::int64_t samples) {
  while (samples % wanted != 0) --wanted;
  return wanted;
}

}  // namespace

RenderConfig resolved(RenderConfig config, std::int64_t pixels) {
  if (config.photons.global < 0) {
    config.photons.global = std::max<std::int64_t>(50'000, pixels / 2);
  }
  if (config.eye.samples_per_pass < 0) {
    const bool photons = config.integrator == Integrator::photon;
    const std::int64_t wanted = photons ? kEyeSamplesPerPhoton * config.photons.global / pixels : 1;
    config.eye.samples_per_pass = static_cast<int>(
        dividing(std::clamp<std::int64_t>(wanted, 1, kMostEyeSamples), config.stop.samples));
  }
  return config;
}

void check(const RenderConfig& config) {
  require(config.photons.global >= 1 || config.photons.global == -1,
          "photons.global must be at least 1, or -1 for automatic");
  require(config.photons.caustic >= -1, "photons.caustic must be 0 or more, or -1 for automatic");
  require(config.photons.global_radius > 0, "photons.global_radius must be above 0");
  require(config.photons.caustic_radius > 0, "photons.caustic_radius must be above 0");
  require(config.photons.alpha > 0 && config.photons.alpha <= 1, "photons.alpha must be in (0, 1]");
  require(config.eye.gather_rays >= 1, "eye.gather_rays must be at least 1");
  require(config.eye.light_samples >= 1, "eye.light_samples must be at least 1");
  require(config.eye.samples_per_pass >= 1 || config.eye.samples_per_pass == -1,
          "eye.samples_per_pass must be at least 1, or -1 for automatic");
  require(config.eye.direct_samples >= -1,
          "eye.direct_samples must be 0 or more, or -1 for automatic");
  require(config.eye.retrace >= 0, "eye.retrace must be 0 or more");
  require(config.eye.reuse >= 0 && config.eye.reuse <= 1, "eye.reuse must be in [0, 1]");
  require(config.eye.share >= 0 && config.eye.share <= 1, "eye.share must be in [0, 1]");
  require(config.stop.passes >= 0, "stop.passes must be 0 or more");
  require(config.stop.samples >= 0, "stop.samples must be 0 or more");
  require(config.stop.seconds >= 0, "stop.seconds must be 0 or more");
  require(config.stop.error >= 0, "stop.error must be 0 or more");
  make_estimator(config.estimator);
}

}  // namespace octolux
