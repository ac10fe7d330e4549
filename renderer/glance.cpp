// glance.h.
#include "renderer/glance.h"

#include "renderer/roulette.h"
#include "renderer/scene.h"

namespace octolux {

namespace {

constexpr int kMaxBounces = 32;  // specular ones, without roulette

}  // namespace

Ray random_eye_ray(const Scene& scene, Rng& rng) {
  const Vec2 u = rng.uniform2();
  const Vec2 lens = rng.uniform2();
  const Vec2 pixel{u.x * static_cast<float>(scene.film.crop_width),
                   u.y * static_cast<float>(scene.film.crop_height)};
  return scene.camera.ray(pixel, lens);
}

void follow_to_smooth(Tracer& tracer, Ray ray, const std::function<void(const Scattering&)>& see) {
  Rgb beta(1);
  for (int bounces = 0, segments = 0; bounces < kMaxBounces; ++bounces) {
    const std::optional<SurfaceHit> hit = tracer.next(ray, beta, segments);
    if (!hit) return;
    const Scattering at(hit->point, *hit->bsdf, -ray.direction, Carried::radiance);
    if (hit->bsdf->has(Lobes::smooth)) return see(at);
    const std::optional<BsdfSample> s = sample_lobes(tracer.rng, at, Lobes::specular);
    if (!s) return;
    ray = at.spawn(s->wi);
  }
}

void gather_from(Tracer& tracer, const Scattering& at, int rays,
                 const std::function<void(const Scattering&)>& see) {
  for (int i = 0; i < rays; ++i) {
    const std::optional<BsdfSample> s = sample_lobes(tracer.rng, at, Lobes::smooth);
    if (s) follow_to_smooth(tracer, at.spawn(s->wi), see);
  }
}

}  // namespace octolux
