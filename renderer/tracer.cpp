// tracer.h: closest hits, pass-through, shadow rays.
#include "renderer/tracer.h"

namespace octolux {

std::optional<SurfaceHit> Tracer::next(Ray ray, Rgb& weight, int& segments) {
  float distance = 0;
  while (true) {
    ++segments;
    count(ray, false);
    const std::optional<RayHit> hit = scene_.caster->closest(ray);
    if (!hit) return std::nullopt;
    distance += hit->t;
    const Bsdf& bsdf = scene_.bsdf(hit->shape);
    SurfaceHit surface{scene_.caster->surface(*hit), &bsdf, scene_.area_light_of_shape[hit->shape],
                       distance};
    if (bsdf.needs_tangents()) scene_.caster->add_tangents(*hit, surface.point);
    if (!bsdf.passes_light()) return surface;

    const Scattering at(surface.point, bsdf, -ray.direction, Carried::radiance);
    const Rgb passed = at.pass_through();
    // What emits must be met now and then, even if it lets everything pass.
    const float most = surface.light ? 0.5f : 1;
    const float probability = std::min(most, max_component(passed));
    if (!(rng.uniform() < probability)) {
      weight *= 1 / (1 - probability);
      return surface;
    }
    weight *= passed / probability;
    ray = {at.spawn(ray.direction).origin, ray.direction};
  }
}

namespace {

/// A ray from `from` that ends (t = 1) at the light, both ends moved off their surfaces.
Ray connect(const SurfacePoint& from, const LightSample& light) {
  if (light.infinite) {
    return {offset_origin(from.position, from.ng, from.error, light.wi), light.wi};
  }
  return connecting_ray({from.position, from.ng, from.error},
                        {light.at.position, light.at.ng, light.at.error});
}

}  // namespace

Rgb Tracer::visibility(const SurfacePoint& from, const LightSample& light, int max_crossings) {
  Ray ray = connect(from, light);
  count(ray, true);
  if (!scene_.any_pass_through) return Rgb(scene_.caster->occluded(ray) ? 0.0f : 1.0f);

  Rgb share(1);
  for (int crossings = 0;; ++crossings) {
    const std::optional<RayHit> hit = scene_.caster->closest(ray);
    if (!hit) return share;
    const Bsdf& bsdf = scene_.bsdf(hit->shape);
    if (!bsdf.passes_light() || crossings == max_crossings) return Rgb(0);
    const SurfacePoint point = scene_.caster->surface(*hit);
    const Scattering at(point, bsdf, -light.wi, Carried::radiance);
    share *= at.pass_through();
    if (is_black(share)) return share;
    ray = connect(point, light);
    count(ray, true);
  }
}

}  // namespace octolux
