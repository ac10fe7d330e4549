// What follows from a scene's lists: the ray caster, the lights of shapes, the bounds of lights.
#include "renderer/scene.h"

#include <cmath>

#include "core/error.h"

namespace octolux {

void Scene::complete() {
  if (shapes.empty()) throw Error("the scene has no shapes");
  caster = std::make_unique<RayCaster>(shapes);
  bounds = caster->bounds();
  if (bounds.empty() || !is_finite(bounds.lower) || !is_finite(bounds.upper)) {
    throw Error("the scene has no triangles, or a vertex that is not finite");
  }
  camera = Camera(camera_config, film);
  area_light_of_shape.assign(shapes.size(), nullptr);
  total_area = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Bsdf& scattering = bsdf(static_cast<std::uint32_t>(i));
    any_pass_through |= scattering.passes_light();
    any_specular |= scattering.has(Lobes::specular);
    total_area += area(shapes[i]);
    if (shapes[i].light >= 0) {
      area_light_of_shape[i] = dynamic_cast<const AreaLight*>(lights[shapes[i].light].get());
    }
  }
  Bounds everything = bounds;
  everything.add(camera_config.to_world.point({0, 0, 0}));
  for (const std::unique_ptr<Light>& light : lights) {
    light->set_scene_bounds(everything.center(), everything.radius());
    if (const auto* sky = dynamic_cast<const EnvironmentLight*>(light.get())) environment = sky;
  }
}

}  // namespace octolux
