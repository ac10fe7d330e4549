// camera.h: the image plane z = 1 of camera space is carried into the world once, in double; a ray
// is then a corner, two edges and a square root.
#include "core/camera.h"

#include <cmath>
#include <numbers>

#include "core/sampling.h"
#include "core/vec3d.h"

namespace octolux {
namespace {

Vec3d column(const Affine& a, int j) { return {a.m[0][j], a.m[1][j], a.m[2][j]}; }

}  // namespace

Camera::Camera(const CameraConfig& config, const FilmSize& film) : config_(config) {
  const Vec3d x = column(config.to_world, 0);
  const Vec3d y = column(config.to_world, 1);
  const Vec3d z = column(config.to_world, 2);
  // A^-T (0, 0, 1) is the normal of the planes z = const, whatever A shears or mirrors: every ray
  // of the picture has a positive cosine with it.
  const Vec3d normal = cross(x, y);
  forward_ = unit_or(dot(normal, z) < 0 ? normal * -1 : normal, {0, 0, 1});
  origin_ = to_float(column(config.to_world, 3));
  axis_ = to_float(z);

  // At z = 1 the film spans +-half_width; x runs left, so pixels count down from +half_width.
  const bool parallel = config.projection == Projection::orthographic;
  const double half_width = parallel ? 1 : std::tan(config.fov_x_degrees * std::numbers::pi / 360);
  const double pixel = 2 * half_width / film.width;
  const double left = film.width * (0.5 - config.principal_offset.x) - film.crop_x;
  const double up = film.height * (0.5 - config.principal_offset.y) - film.crop_y;
  corner_ = to_float(x * (pixel * left) + y * (pixel * up) + (parallel ? Vec3d{} : z));
  dx_ = to_float(x * -pixel);
  dy_ = to_float(y * -pixel);
  lens_x_ = to_float(x * config.aperture_radius);
  lens_y_ = to_float(y * config.aperture_radius);
}

Ray Camera::ray(Vec2 p, Vec2 u_lens) const {
  const Vec3 pixel = corner_ + dx_ * p.x + dy_ * p.y;
  Vec3 origin = origin_, direction = pixel;
  if (config_.projection == Projection::orthographic) {
    origin += pixel;
    direction = axis_;
  } else if (has_lens()) {
    const Vec2 d = sample_disk(u_lens);
    const Vec3 off_centre = lens_x_ * d.x + lens_y_ * d.y;
    origin += off_centre;
    direction = pixel * config_.focus_distance - off_centre;
  }
  direction = normalize(direction);
  const float per_depth = 1 / dot(direction, forward_);
  return {origin, direction, config_.near_clip * per_depth, config_.far_clip * per_depth};
}

}  // namespace octolux
