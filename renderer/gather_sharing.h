// What the final gathers of neighbouring pixels share. Indirect light on a diffuse surface changes
// slowly, on the scale of the distance to the things around (Ward, Rubinstein & Clear, "A ray
// tracing solution for diffuse interreflection", SIGGRAPH 1988), while each gather knows it by a
// few rays only. So within a small share of that distance a pixel takes the mean of its neighbours'
// gathers, as the surface would see them were it white; its own texture, direct light and caustics
// stay its own, and so does the gloss of a coat. Towards a wall close by that is next to nothing,
// and no light goes around it, as it is farther from either side than the share. Along that wall
// light changes no faster than elsewhere: there, as in a corner along its edge, the next few pixels
// share, but none farther off. What mirrors and glass show is shared by the places that are seen
// there.
//
// Neighbours count in pairs, one on either side and each as much as the other, so that a slope of
// the irradiance cancels, and only its curvature is blurred. How far is known before the first
// pass, from rays of their own: told by the gather rays that are averaged, darkness near things
// would be counted too much. It shrinks with the bandwidth, so a render converges to the same
// picture with sharing and without.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "core/constants.h"
#include "core/image.h"
#include "renderer/config.h"
#include "renderer/scene.h"

namespace octolux {

/// How an eye path came where it is: by which specular lobes, told apart by the side they scatter
/// to. Paths of the same way see neighbouring places.
class Way {
 public:
  /// Goes on to another surface.
  void add(bool transmitted) { turns_ = 2 * turns_ + (transmitted ? 1 : 0); }
  auto operator<=>(const Way&) const = default;

 private:
  std::uint64_t turns_ = 1;
};

/// What an eye path gathered on the first surface it met that is Lambertian, or is so under a coat:
/// of that one what comes through the coat, its gloss not.
struct Gathered {
  Vec3 position, normal;  // [m], facing shading normal
  Rgb reflectance;        // times the weight of the path
  Rgb radiance;           // [W m^-2 sr^-1], were the surface white
  int segments = 0;       // from the eye
  Way way = {};
  const Bsdf* coated = nullptr;  // the BSDF, if there is a coat: others pass other light
  bool diffuse = false;          // else nothing of the above is set: there was none

  /// What the eye sees of it, if the surface is lit so.
  Rgb seen(Rgb lit) const { return reflectance * lit; }
};

/// How far apart pixels may be that share along what is close. Farther ones share only where all
/// that lies around is farther than the share, of the one as of the other.
inline constexpr int kAlongPixels = 3;

/// One of each pixel, row by row, all at the same place of their pixels.
struct GatheredGrid {
  int width = 0, height = 0;
  std::vector<Gathered> pixels;

  const Gathered& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// How near things around a point are, by the direction in which it might be moved.
class Nearness {
 public:
  Nearness() = default;
  /// [1/m], the same in every direction.
  explicit Nearness(float even) : even_(even) {}
  /// Adds a thing `inverse` [1/m] away. Moved across its surface, that is how near it is; moved
  /// along it, no nearer than `most`.
  void add(float inverse, Vec3 normal, float most);
  Nearness operator*(float factor) const;
  /// |d| [m] times the nearness along d: |d| even + sum of d_i d_j excess_ij / |d|.
  float times(Vec3 d) const;
  float even() const { return even_; }
  Vec3 excess_squares() const { return squares_; }    // xx, yy, zz
  Vec3 excess_products() const { return products_; }  // yz, zx, xy
  /// Were each thing as near whatever the way: no less than in any direction.
  float most() const { return even_ + squares_.x + squares_.y + squares_.z; }

 private:
  float even_ = 0;
  // What is more across surfaces: the sum of excess * normal normal^T.
  Vec3 squares_{}, products_{};
};

/// How far a pixel shares what paths of one way gather; those of others share nothing.
struct SharingLimit {
  Nearness nearness{kInfinity};  // by eye.share: how far is its inverse, unless told nothing
  Way way = {};
};

/// How far each pixel shares (shared_gathers.h does). Immutable, so thread-safe.
class GatherSharing {
 public:
  /// No pixel does.
  GatherSharing() = default;
  /// One for each pixel, row by row.
  explicit GatherSharing(std::vector<SharingLimit> limits) : limits_(std::move(limits)) {}

  bool any() const { return !limits_.empty(); }
  /// Row by row; empty if no pixel shares.
  const std::vector<SharingLimit>& limits() const { return limits_; }

 private:
  std::vector<SharingLimit> limits_;
};

/// The share eye.share of the harmonic mean distance of what lies around, cosines weighed, as a few
/// rays from each pixel and its neighbours find it; what is close lies, for moves along its
/// surface, so far away that the pixels next to it share. The same on any number of threads.
GatherSharing learn_sharing(const Scene& scene, const RenderConfig& config);

}  // namespace octolux
