// direct_light.h.
#include "renderer/direct_light.h"

#include "core/sampling.h"

namespace octolux {

namespace {

/// Of light from `light`.
float bsdf_share(const Arrival& arrival, const Light& light, float light_pdf_w) {
  return power_heuristic(static_cast<float>(arrival.bsdf_samples), arrival.pdf_w,
                         static_cast<float>(arrival.light_samples.of(light)), light_pdf_w);
}

PointSet points_if_any(int n, Rng& rng) { return n > 0 ? PointSet(n, rng) : PointSet(0, 0u); }

}  // namespace

LightPoints::LightPoints(LightSamples n, Rng& rng)
    : places(points_if_any(n.others, rng)),
      narrow(points_if_any(n.narrow, rng)),
      choice(rng.uniform()) {}

Receiver receiver(const Scattering& at) {
  const SurfacePoint& point = at.point();
  const bool transmits = at.bsdf().smooth_transmission() || at.bsdf().has(Lobes::near_specular);
  return {point.position, dot(at.wo(), point.ns) < 0 ? -point.ns : point.ns, transmits};
}

Rgb sample_lights(Tracer& tracer, const LightSampler& lights, const Scattering& at,
                  const Receiver& lit, const DirectStrategy& strategy, const LightPoints& points) {
  if (lights.empty() || strategy.max_crossings < 0) return Rgb(0);
  Rgb others(0), narrow(0);
  const LightSamples n = strategy.light_samples;
  const auto u_light = [&](int i, int of) {
    return std::min(kOneMinusEpsilon,
                    (static_cast<float>(i) + points.choice) / static_cast<float>(of));
  };
  for (int i = 0; i < n.others; ++i) {
    const LightSampler::Choice choice = lights.sample(lit, u_light(i, n.others));
    others += sample_light(tracer, choice, points.places[i], at, strategy);
  }
  for (int i = 0; i < n.narrow; ++i) {
    const LightSampler::Choice choice = lights.sample_narrow(u_light(i, n.narrow));
    narrow += sample_light(tracer, choice, points.narrow[i], at, strategy);
  }
  const auto mean = [](Rgb sum, int of) { return of > 0 ? sum / static_cast<float>(of) : sum; };
  return mean(others, n.others) + mean(narrow, n.narrow);
}

Rgb sample_light(Tracer& tracer, const LightSampler::Choice& choice, Vec2 u, const Scattering& at,
                 const DirectStrategy& strategy) {
  if (!choice.light) return Rgb(0);
  const std::optional<LightSample> light = choice.sample(at.point().position, u);
  if (!light) return Rgb(0);
  const Rgb scattered = at.f_cos(light->wi, strategy.lobes) * light->radiance;
  if (is_black(scattered)) return Rgb(0);
  const float pdf_w = choice.pmf * light->pdf_w;
  const float share =
      light->delta ? 1.0f
                   : power_heuristic(static_cast<float>(strategy.light_samples.of(*choice.light)),
                                     pdf_w, static_cast<float>(strategy.bsdf_samples),
                                     at.pdf_w(light->wi, strategy.sampled));
  const Rgb value = scattered * (share / pdf_w);
  return is_black(value) ? value
                         : value * tracer.visibility(at.point(), *light, strategy.max_crossings);
}

Rgb emitted(const LightSampler& lights, const SurfaceHit& hit, Vec3 wo, const Arrival& arrival) {
  if (!hit.light) return Rgb(0);
  const Rgb radiance = hit.light->radiance(hit.point, wo);
  if (is_black(radiance) || !arrival.light_samples.any()) return radiance;
  const float pdf_w = lights.pdf_w(arrival.from, *hit.light, hit.point);
  return radiance * bsdf_share(arrival, *hit.light, pdf_w);
}

Rgb environment(const Scene& scene, const LightSampler& lights, Vec3 wi, const Arrival& arrival) {
  Rgb total(0);
  for (const EnvironmentLight* light : scene.environment) {
    const Rgb radiance = light->radiance(wi);
    if (is_black(radiance)) continue;
    const bool sampled = arrival.light_samples.any();
    const float pdf_w = sampled ? lights.pdf_w(arrival.from, *light, wi) : 0;
    total += radiance * (sampled ? bsdf_share(arrival, *light, pdf_w) : 1);
  }
  return total;
}

}  // namespace octolux
