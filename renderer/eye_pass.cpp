// eye_pass.h.
#include "renderer/eye_pass.h"

#include "renderer/roulette.h"

namespace octolux {

namespace {

/// Direct light by the non-delta specular lobes of `at`: L S* E found from the light's side.
Rgb near_specular_direct(Tracer& tracer, const LightSampler& lights, const Scattering& at,
                         int max_crossings) {
  if (!at.bsdf().has(Lobes::near_specular)) return Rgb(0);
  const DirectStrategy strategy{Lobes::near_specular, Lobes::specular, 1, 1, max_crossings};
  return sample_lights(tracer, lights, at, receiver(at), strategy, {1, tracer.rng});
}

}  // namespace

EyeSample trace_eye_path(Tracer& tracer, const LightSampler& lights, const FinalGather& gather,
                         Ray ray) {
  const Scene& scene = tracer.scene();
  const int max_segments = scene.max_depth < 0 ? 1 << 20 : scene.max_depth;
  EyeSample out;
  Rgb beta(1);
  float eta = 1;
  int segments = 0;
  Arrival arrival;
  for (int bounces = 0; segments < max_segments; ++bounces) {
    const bool visible = bounces > 0 || !scene.hide_emitters;
    const std::optional<SurfaceHit> hit = tracer.next(ray, beta, segments);
    if (segments > max_segments) break;
    if (!hit) {
      if (visible) out.direct += beta * environment(scene, lights, ray.direction, arrival);
      break;
    }
    const Vec3 wo = -ray.direction;
    if (visible) out.direct += beta * emitted(lights, *hit, wo, arrival);
    if (bounces == 0) describe_first_hit(out, scene, *hit, ray);
    const Scattering at(hit->point, *hit->bsdf, wo, Carried::radiance);
    if (hit->bsdf->has(Lobes::smooth)) {
      const SplitRadiance leaving = gather.radiance(tracer, at, segments);
      out.direct += beta * leaving.direct;
      out.caustic += beta * leaving.caustic;
      out.indirect += beta * leaving.indirect;
    }
    if (!hit->bsdf->has(Lobes::specular)) break;
    out.direct += beta * near_specular_direct(tracer, lights, at, max_segments - segments - 1);
    const std::optional<BsdfSample> sample = sample_lobes(tracer.rng, at, Lobes::specular);
    if (!sample) break;
    beta *= sample->weight;
    eta *= sample->eta;
    if (bounces >= kSafeBounces && !survives(tracer.rng, beta, survival(beta, eta))) break;
    ray = at.spawn(sample->wi);
    arrival = {receiver(at), sample->pdf_w, 1,
               sample->lobe == Lobes::near_specular && !scene.lights.empty() ? 1 : 0};
  }
  return out;
}

}  // namespace octolux
