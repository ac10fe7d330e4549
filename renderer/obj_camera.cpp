// Distances from similar triangles; see obj_camera.h.
#include "renderer/obj_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace octolux {
namespace {

constexpr float kFovDegrees = 45;
constexpr float kMargin = 1.05f;  // picture's width over the model's
constexpr int kPixels = 512;

Vec3 camera_position(const Bounds& bounds) {
  const Vec3 half = (bounds.upper - bounds.lower) * 0.5f;
  // A model without width (a curtain seen edge-on) is given that of its depth.
  float width = std::max(half.x, half.y);
  if (!(width > 0)) width = half.z;
  const float distance = kMargin * width / std::tan(kFovDegrees * 0.5f * kPi / 180);
  const Vec3 center = bounds.center();
  return {center.x, center.y, bounds.upper.z + distance};
}

}  // namespace

void frame_model(const Bounds& bounds, Scene& scene) {
  const Vec3 origin = camera_position(bounds), center = bounds.center();
  const float front = origin.z - bounds.upper.z, back = origin.z - bounds.lower.z;
  // Camera space looks along +z with x to the left; turned half around y it looks along -z.
  scene.camera_config.to_world = translation(origin.x, origin.y, origin.z) * rotation(0, 1, 0, 180);
  scene.camera_config.fov_x_degrees = kFovDegrees;
  scene.camera_config.near_clip = 0.01f * front;
  scene.camera_config.far_clip = 2 * back;
  scene.film = {kPixels, kPixels, 0, 0, kPixels, kPixels};
  scene.warnings.push_back(fmt::format(
      "no camera in an OBJ file: placed one at ({:.4g}, {:.4g}, {:.4g}) looking at ({:.4g}, "
      "{:.4g}, "
      "{:.4g}), {} degrees, {} x {} pixels",
      origin.x, origin.y, origin.z, center.x, center.y, center.z, kFovDegrees, kPixels, kPixels));
}

void add_headlight(const Bounds& bounds, Scene& scene) {
  const Vec3 position = camera_position(bounds);
  const float distance2 = length2(position - bounds.center());
  // White Lambertian: radiance = E / pi with E = intensity / distance^2.
  const float intensity = 0.5f * kPi * distance2;
  scene.lights.push_back(make_point_light(position, Rgb(intensity)));
  scene.warnings.push_back(fmt::format(
      "nothing emits light: placed a point light of {:.4g} W/sr at the camera", intensity));
}

}  // namespace octolux
