// A perspective camera, as Mitsuba's `perspective` sensor.
#pragma once

#include "core/affine.h"
#include "core/ray.h"
#include "core/vec.h"

namespace octolux {

/// The picture's size; the crop window is what is rendered and written.
struct FilmSize {
  int width = 768, height = 576;  // of the whole film [pixels]
  int crop_x = 0, crop_y = 0;
  int crop_width = 768, crop_height = 576;  // at least 1
};

struct CameraConfig {
  Affine to_world;              // camera space: x left, y up, z forward (Mitsuba); may be mirrored
  float fov_x_degrees = 39.6f;  // full horizontal angle of the whole film, in (0, 180)
  float near_clip = 1e-2f;      // [m] along the view axis
  float far_clip = 1e4f;
  Vec2 principal_offset{0, 0};  // Mitsuba's principalPointOffset, in fractions of the film
};

class Camera {
 public:
  Camera() : Camera(CameraConfig{}, FilmSize{}) {}
  Camera(const CameraConfig& config, const FilmSize& film);

  /// The ray through `p` [pixels of the crop window; (0, 0) is its top left corner].
  Ray ray(Vec2 p) const;
  /// Cosine between the ray through `p` and the view axis (depth = t * cosine).
  Vec3 forward() const { return forward_; }
  const CameraConfig& config() const { return config_; }

 private:
  CameraConfig config_;
  Vec3 origin_;
  Vec3 forward_;  // unit
  Vec3 corner_;   // direction through the crop window's top left corner, at z = 1
  Vec3 dx_, dy_;  // change of that direction per pixel
};

}  // namespace octolux
