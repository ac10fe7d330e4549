// The camera, as Mitsuba's sensors `perspective`, `thinlens` and `orthographic`: camera space has x
// to the left of the picture, y up and z forward, so an ordinary (not mirrored) to_world does not
// mirror the picture. Only rays' directions feel a scale in to_world; clip distances are metres of
// the world. Immutable after construction, so thread-safe.
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

enum class Projection { perspective, orthographic };

struct CameraConfig {
  Projection projection = Projection::perspective;
  Affine to_world;              // invertible; may be mirrored or scaled unevenly
  float fov_x_degrees = 39.6f;  // full horizontal angle of the whole film, in (0, 180)
  float near_clip = 1e-2f;      // [m] along the view axis
  float far_clip = 1e4f;
  Vec2 principal_offset{0, 0};  // Mitsuba's principalPointOffset, in fractions of the whole film:
                                // pixel p shows what p + offset * size showed without
  // A lens instead of a pinhole; both lengths in camera space, as Mitsuba has them.
  float aperture_radius = 0;
  float focus_distance = 1;  // along the view axis
};

class Camera {
 public:
  Camera() : Camera(CameraConfig{}, FilmSize{}) {}
  Camera(const CameraConfig& config, const FilmSize& film);

  /// Is the picture's sharpness that of a lens? Then rays need a place on it.
  bool has_lens() const { return config_.aperture_radius > 0; }

  /// The ray through `p` [pixels of the crop window; (0, 0) is its top left corner, pixel centres
  /// are at half]. It starts at the eye (or on the plane z = 0 if orthographic), and its t interval
  /// ends at the clip planes. `u_lens` in the unit square chooses where it leaves the lens.
  Ray ray(Vec2 p, Vec2 u_lens = {0.5f, 0.5f}) const;
  /// Normal of the image plane, the view axis: depth of a hit = t * dot(ray.direction, forward()).
  Vec3 forward() const { return forward_; }
  const CameraConfig& config() const { return config_; }

 private:
  CameraConfig config_;
  Vec3 origin_;
  Vec3 forward_;  // unit
  Vec3 axis_;     // camera space's z, as long as to_world makes it
  Vec3 corner_;   // direction through the crop window's top left corner, at z = 1; orthographic:
                  // from the origin to that corner
  Vec3 dx_, dy_;  // change of that per pixel
  Vec3 lens_x_, lens_y_;  // from the lens's centre to its rim
};

}  // namespace octolux
