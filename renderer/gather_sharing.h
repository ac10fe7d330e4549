// What the final gathers of neighbouring pixels share. Indirect light on a diffuse surface changes
// slowly, on the scale of the distance to the things around (Ward, Rubinstein & Clear, "A ray
// tracing solution for diffuse interreflection", SIGGRAPH 1988), while each gather knows it by a
// few rays only. So within a small share of that distance a pixel takes the mean of its neighbours'
// gathers, as the surface would see them were it white; its own texture, direct light and caustics
// stay its own. In corners, and where things touch, that is next to nothing, and no light goes
// around a wall, which is farther from either side of it than the share.
//
// Neighbours count in pairs, one on either side and each as much as the other, so that a slope of
// the irradiance cancels, and only its curvature is blurred. How far is known before the first
// pass, from rays of their own: told by the gather rays that are averaged, darkness near things
// would be counted too much. It shrinks with the bandwidth, so a render converges to the same
// picture with sharing and without.
#pragma once

#include <vector>

#include "core/image.h"
#include "renderer/config.h"
#include "renderer/scene.h"

namespace octolux {

/// What an eye path gathered on the first surface it met, if that is Lambertian.
struct Gathered {
  Vec3 position, normal;    // [m], facing shading normal
  Rgb reflectance;          // times the weight of the path
  Rgb radiance;             // [W m^-2 sr^-1], were the surface white
  int segments = 0;         // from the eye
  bool lambertian = false;  // else nothing of the above is set

  /// What the eye sees of it, if the surface is lit so.
  Rgb seen(Rgb lit) const { return reflectance * lit; }
};

/// One of each pixel, row by row, all at the same place of their pixels.
struct GatheredGrid {
  int width = 0, height = 0;
  std::vector<Gathered> pixels;

  const Gathered& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// How far each pixel shares. Immutable, so thread-safe.
class GatherSharing {
 public:
  /// No pixel does.
  GatherSharing() = default;
  /// Each as far [m] as `reach` has it, row by row.
  explicit GatherSharing(std::vector<float> reach) : reach_(std::move(reach)) {}

  bool any() const { return !reach_.empty(); }
  /// If any pixel shares: `radiance` of a Lambertian pixel, averaged over those within `shrink`
  /// times its reach.
  Rgb shared(const GatheredGrid& grid, int x, int y, float shrink) const;
  /// [m], row by row; empty if no pixel shares.
  const std::vector<float>& reach() const { return reach_; }

 private:
  std::vector<float> reach_;
};

/// The share eye.share of the harmonic mean distance of what lies around, cosines weighed, as a few
/// rays from each pixel and its neighbours find it. The same on any number of threads.
GatherSharing learn_sharing(const Scene& scene, const RenderConfig& config);

}  // namespace octolux
