// eye_pass.h.
#include "renderer/eye_pass.h"

#include "renderer/roulette.h"

namespace octolux {

namespace {

/// Direct light by the non-delta specular lobes of `at`: L S* E found from the light's side.
Rgb glossy_direct(Tracer& tracer, const LightSampler& lights, const Scattering& at,
                  LightSamples samples, int segments, int max_crossings) {
  if (!at.bsdf().has(Lobes::near_specular)) return Rgb(0);
  const DirectStrategy strategy{Lobes::near_specular, Lobes::specular, samples, 1, max_crossings};
  const auto points = [&](PixelUse use, int n) { return tracer.sequence.points(use, segments, n); };
  return sample_lights(
      tracer, lights, at, receiver(at), strategy,
      {points(PixelUse::glossy_lights, samples.others), points(PixelUse::glossy_light_choice, 1),
       points(PixelUse::glossy_narrow_lights, samples.narrow)});
}

/// Draws among the specular lobes of `at`. The choices of a pixel, reflected or refracted above
/// all, follow its own sequence, so that it sees as much of each as it should.
std::optional<BsdfSample> sample_specular(Tracer& tracer, const Scattering& at, int segments) {
  const PixelSequence& sequence = tracer.sequence;
  const float u_lobe = sequence.points(PixelUse::specular_lobe, segments, 1)[0].x;
  const Vec2 u = sequence.points(PixelUse::specular_direction, segments, 1)[0];
  return at.sample(u_lobe, u, Lobes::specular);
}

/// What is gathered where the path meets a surface, over `segments` segments; nothing if that is
/// not Lambertian.
Gathered gathered(const Scattering& at, Rgb weight, Rgb radiance, int segments, Way way) {
  const std::optional<Rgb> reflectance = at.diffuse_reflectance();
  if (!reflectance) return {};
  const auto white = [&](int c) {
    return (*reflectance)[c] > 0 ? radiance[c] / (*reflectance)[c] : 0.0f;
  };
  return {.position = at.point().position,
          .normal = at.facing_shading_normal(),
          .reflectance = weight * *reflectance,
          .radiance = {white(0), white(1), white(2)},
          .segments = segments,
          .way = way,
          .lambertian = true};
}

/// Follows specular chains along `ray`. At surfaces with smooth lobes add(out, at, weight,
/// segments, way) adds what leaves them.
template <class Add>
EyeSample follow_eye_path(Tracer& tracer, const LightSampler& lights, Ray ray,
                          LightSamples light_samples, Add add) {
  const Scene& scene = tracer.scene();
  const int max_segments = scene.max_depth < 0 ? 1 << 20 : scene.max_depth;
  EyeSample out;
  Rgb beta(1);
  float eta = 1;
  int segments = 0;
  Way way;
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
    if (hit->bsdf->has(Lobes::smooth)) add(out, at, beta, segments, way);
    if (!hit->bsdf->has(Lobes::specular)) break;
    out.direct += beta * glossy_direct(tracer, lights, at, light_samples, segments,
                                       max_segments - segments - 1);
    const std::optional<BsdfSample> sample = sample_specular(tracer, at, segments);
    if (!sample) break;
    beta *= sample->weight;
    eta *= sample->eta;
    if (bounces >= kSafeBounces && !survives(tracer.rng, beta, survival(beta, eta))) break;
    way.add(at.transmits(sample->wi));
    ray = at.spawn(sample->wi);
    arrival = {receiver(at), sample->pdf_w, 1,
               sample->lobe == Lobes::near_specular ? light_samples : LightSamples()};
  }
  return out;
}

}  // namespace

EyeSample trace_eye_path(Tracer& tracer, const LightSampler& lights, const FinalGather& gather,
                         Ray ray, Gathered* apart) {
  const auto add = [&](EyeSample& out, const Scattering& at, Rgb weight, int segments, Way way) {
    const SplitRadiance leaving = gather.radiance(tracer, at, segments);
    out.direct += weight * leaving.direct;
    out.caustic += weight * leaving.caustic;
    const bool first = apart && !apart->lambertian;
    if (first) *apart = gathered(at, weight, leaving.indirect, segments, way);
    if (!first || !apart->lambertian) out.indirect += weight * leaving.indirect;
  };
  return follow_eye_path(tracer, lights, ray, gather.light_samples(), add);
}

EyeSample trace_direct_path(Tracer& tracer, const LightSampler& lights, const FinalGather& gather,
                            Ray ray) {
  const auto add = [&](EyeSample& out, const Scattering& at, Rgb weight, int segments, Way) {
    const SplitRadiance leaving = gather.direct(tracer, at, segments);
    out.direct += weight * leaving.direct;
    out.caustic += weight * leaving.caustic;
  };
  return follow_eye_path(tracer, lights, ray, gather.light_samples(), add);
}

}  // namespace octolux
