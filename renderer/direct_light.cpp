// direct_light.h.
#include "renderer/direct_light.h"

#include "core/sampling.h"

namespace octolux {

namespace {

float bsdf_share(const Arrival& arrival, float light_pdf_w) {
  if (arrival.light_samples == 0) return 1;
  return power_heuristic(static_cast<float>(arrival.bsdf_samples), arrival.pdf_w,
                         static_cast<float>(arrival.light_samples), light_pdf_w);
}

}  // namespace

Receiver receiver(const Scattering& at) {
  const SurfacePoint& point = at.point();
  const bool transmits = at.bsdf().smooth_transmission() || at.bsdf().has(Lobes::near_specular);
  return {point.position, dot(at.wo(), point.ns) < 0 ? -point.ns : point.ns, transmits};
}

Rgb sample_lights(Tracer& tracer, const LightSampler& lights, const Scattering& at,
                  const Receiver& lit, const DirectStrategy& strategy, const LightPoints& points) {
  if (lights.empty() || strategy.max_crossings < 0) return Rgb(0);
  Rgb total(0);
  const auto n = static_cast<float>(strategy.light_samples);
  for (int i = 0; i < strategy.light_samples; ++i) {
    const float u_light = (static_cast<float>(i) + points.choice) / n;
    const LightSampler::Choice choice = lights.sample(lit, std::min(kOneMinusEpsilon, u_light));
    total += sample_light(tracer, choice, points.places[i], at, strategy);
  }
  return total / n;
}

Rgb sample_light(Tracer& tracer, const LightSampler::Choice& choice, Vec2 u, const Scattering& at,
                 const DirectStrategy& strategy) {
  if (!choice.light) return Rgb(0);
  const std::optional<LightSample> light = choice.sample(at.point().position, u);
  if (!light) return Rgb(0);
  const Rgb scattered = at.f_cos(light->wi, strategy.lobes) * light->radiance;
  if (is_black(scattered)) return Rgb(0);
  const float pdf_w = choice.pmf * light->pdf_w;
  const float share = light->delta
                          ? 1.0f
                          : power_heuristic(static_cast<float>(strategy.light_samples), pdf_w,
                                            static_cast<float>(strategy.bsdf_samples),
                                            at.pdf_w(light->wi, strategy.sampled));
  const Rgb value = scattered * (share / pdf_w);
  return is_black(value) ? value
                         : value * tracer.visibility(at.point(), *light, strategy.max_crossings);
}

Rgb emitted(const LightSampler& lights, const SurfaceHit& hit, Vec3 wo, const Arrival& arrival) {
  if (!hit.light) return Rgb(0);
  const Rgb radiance = hit.light->radiance(hit.point, wo);
  if (is_black(radiance) || arrival.light_samples == 0) return radiance;
  return radiance * bsdf_share(arrival, lights.pdf_w(arrival.from, *hit.light, hit.point));
}

Rgb environment(const Scene& scene, const LightSampler& lights, Vec3 wi, const Arrival& arrival) {
  if (!scene.environment) return Rgb(0);
  const Rgb radiance = scene.environment->radiance(wi);
  if (arrival.light_samples == 0) return radiance;
  const float pmf = lights.pmf_of_environment(arrival.from);
  return radiance * bsdf_share(arrival, pmf * scene.environment->pdf_w(wi));
}

}  // namespace octolux
