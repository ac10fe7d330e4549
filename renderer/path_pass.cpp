// path_pass.h.
#include "renderer/path_pass.h"

#include "renderer/pixels.h"
#include "renderer/roulette.h"

namespace octolux {

EyeSample trace_path(Tracer& tracer, const LightSampler& lights, Ray ray) {
  const Scene& scene = tracer.scene();
  const int max_segments = scene.max_depth < 0 ? 1 << 20 : scene.max_depth;
  const LightSamples light_samples = lights.divided(1);
  EyeSample out;
  Rgb beta(1);
  float eta = 1;
  int segments = 0;
  Arrival arrival;
  for (int bounces = 0; segments < max_segments; ++bounces) {
    const bool visible = bounces > 0 || !scene.hide_emitters;
    Rgb& layer = bounces <= 1 ? out.direct : out.indirect;
    const std::optional<SurfaceHit> hit = tracer.next(ray, beta, segments);
    if (segments > max_segments) break;
    if (!hit) {
      if (visible) layer += beta * environment(scene, lights, ray.direction, arrival);
      break;
    }
    const Vec3 wo = -ray.direction;
    if (visible) layer += beta * emitted(lights, *hit, wo, arrival);
    if (bounces == 0) describe_first_hit(out, scene, *hit, ray);
    if (segments >= max_segments) break;
    const Scattering at(hit->point, *hit->bsdf, wo, Carried::radiance);
    const bool samples_lights = hit->bsdf->has(Lobes::non_delta) && !lights.empty();
    if (samples_lights) {
      Rgb& lit = bounces == 0 ? out.direct : out.indirect;
      const DirectStrategy strategy{.light_samples = light_samples,
                                    .max_crossings = max_segments - segments - 1};
      lit += beta *
             sample_lights(tracer, lights, at, receiver(at), strategy, {light_samples, tracer.rng});
    }
    const std::optional<BsdfSample> sample = sample_lobes(tracer.rng, at, Lobes::all);
    if (!sample) break;
    beta *= sample->weight;
    eta *= sample->eta;
    if (bounces >= kSafeBounces && !survives(tracer.rng, beta, survival(beta, eta))) break;
    ray = at.spawn(sample->wi);
    arrival = {receiver(at), sample->pdf_w, 1,
               samples_lights && sample->lobe != Lobes::delta ? light_samples : LightSamples()};
  }
  return out;
}

}  // namespace octolux
