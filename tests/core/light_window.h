// The flux of a light through a window, by photons and by next-event estimation.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "core/frame.h"
#include "tests/core/light_cases.h"
#include "tests/stats.h"

namespace octolux::test {

/// A square window at `center`, seen as receiver from the side of `n`.
struct Window {
  Vec3 center;
  Frame frame;
  float half;

  Vec3 at(Vec2 u) const {
    return center + frame.s * ((2 * u.x - 1) * half) + frame.t * ((2 * u.y - 1) * half);
  }
  /// Does the ray pass through from the front?
  bool passed_by(const Ray& ray) const {
    const float cosine = -dot(ray.direction, frame.n);
    if (!(cosine > 0)) return false;
    const float t = dot(ray.origin - center, frame.n) / cosine;
    const Vec3 p = ray.origin + ray.direction * t - center;
    return t > 0 && std::abs(dot(p, frame.s)) <= half && std::abs(dot(p, frame.t)) <= half;
  }
};

/// p-value that photons and next-event estimation see the same flux through the window.
inline double same_flux_p(const Light& light, const Window& window, int test) {
  constexpr int kSamples = 200000;
  Running photons, direct;
  Rng rng(1, Stream::test, 73, static_cast<std::uint64_t>(test));
  const float window_area = 4 * window.half * window.half;
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 u = rng.uniform2();
    const EmittedPhoton photon = light.emit(u, rng.uniform2());
    photons.add(window.passed_by(photon.ray) ? photon.flux.g : 0);
    const Vec3 x = window.at(rng.uniform2());
    const std::optional<LightSample> s = light.sample(x, rng.uniform2());
    const float cosine = s ? std::max(0.0f, dot(s->wi, window.frame.n)) : 0;
    direct.add(s ? s->radiance.g * cosine / s->pdf_w * window_area : 0);
  }
  EXPECT_GT(direct.mean(), 0);
  const double variance = photons.variance_of_mean() + direct.variance_of_mean();
  return z_test_p((photons.mean() - direct.mean()) / std::sqrt(variance));
}

}  // namespace octolux::test
