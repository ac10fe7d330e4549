// What follows from a scene's lists: the ray caster, the lights of shapes, the bounds of lights.
#include "renderer/scene.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "renderer/focus.h"

namespace octolux {

void Scene::add_placed_shapes() {
  bsdf_of_shape.clear();
  for (const Shape& shape : shapes) {
    bsdf_of_shape.push_back(bsdfs[static_cast<std::size_t>(shape.bsdf)].get());
    if (shape.group < 0) total_area += area(shape);
  }
  for (const PlacedShape& placed : caster->placed()) {
    bsdf_of_shape.push_back(bsdf_of_shape[placed.shape]);
    total_area += area(shapes[placed.shape], instances[placed.instance].to_world);
  }
  area_light_of_shape.assign(bsdf_of_shape.size(), nullptr);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i].light < 0) continue;
    const Light* light = lights[static_cast<std::size_t>(shapes[i].light)].get();
    area_light_of_shape[i] = dynamic_cast<const AreaLight*>(light);
  }
}

/// Infinite lights send their photons through the portals.
void Scene::aim_lights() {
  if (portals.empty()) return;
  aims_ = std::make_unique<Portals>(portals);
  bool any = false;
  for (std::unique_ptr<Light>& light : lights) {
    if (light->extent()) continue;  // finite
    light = aim_at_portals(std::move(light), *aims_);
    any = true;
  }
  if (!any) warnings.push_back("the portals do nothing: no sun, sky or environment is there");
}

void Scene::complete(const LoadProgress& progress) {
  if (shapes.empty()) throw Error("the scene has no shapes");
  RayCaster::BuildProgress build_progress;
  if (progress) {
    build_progress = [&](double share) { progress("sorting triangles for rays", share); };
  }
  caster = std::make_unique<RayCaster>(shapes, instances, build_progress);
  bounds = caster->bounds();
  if (bounds.empty() || !is_finite(bounds.lower) || !is_finite(bounds.upper)) {
    throw Error("the scene has no triangles, or a vertex that is not finite");
  }
  camera = Camera(camera_config, film);
  add_placed_shapes();
  for (const Bsdf* scattering : bsdf_of_shape) {
    any_pass_through |= scattering->passes_light();
    any_specular |= scattering->has(Lobes::specular);
  }
  aim_lights();
  place_lights();
}

/// Tells lights where the scene is, and where in it they are wanted.
void Scene::place_lights() {
  Bounds everything = bounds;
  everything.add(camera_config.to_world.point({0, 0, 0}));
  environment.clear();
  for (const std::unique_ptr<Light>& light : lights) {
    light->set_scene_bounds(everything.center(), everything.radius());
    const auto* surrounding = dynamic_cast<const EnvironmentLight*>(light.get());
    if (surrounding) environment.push_back(surrounding);
  }
  // Worth a focus: light from far away, and a small part of the scene that it is wanted in.
  constexpr float kSmall = 1 / 8.0f;
  const bool far =
      std::any_of(lights.begin(), lights.end(), [](const auto& l) { return !l->extent(); });
  const std::optional<Focus> found = far ? find_focus(*this) : std::nullopt;
  if (found && found->radius < kSmall * everything.radius()) set_focus(found);
}

void Scene::set_focus(const std::optional<Focus>& wanted) {
  focus = wanted;
  const Focus f = wanted.value_or(Focus{});
  for (const std::unique_ptr<Light>& light : lights) light->set_focus(f.center, f.radius);
}

}  // namespace octolux
