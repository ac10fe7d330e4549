// A part of the tangent plane at a query: the photons of a look-up can be restricted to it.
//
// Star-shaped about the query's position: eight sectors of 45 degrees, each one convex, the
// intersection of at most four half planes. That holds an octagon, the free space feelers find
// (estimators/free_region.h), and the whole plane. Plain data; contains() is inline, because a
// look-up asks it for every photon near enough.
#pragma once

#include <array>
#include <cmath>

#include "core/constants.h"
#include "core/vec.h"

namespace octolux {

/// The half plane a p <= c of the tangent plane, |a| = 1 (or 0: the whole plane). c >= 0: the
/// query's position belongs to it.
struct HalfPlane {
  Vec2 a;
  float c = kInfinity;  // [m] distance of the boundary
};

struct PhotonRegion {
  static constexpr int kSectors = 8;
  static constexpr int kLines = 4;  // per sector

  /// Half planes as a structure of arrays.
  struct Sector {
    std::array<float, kLines> a{}, b{};
    std::array<float, kLines> c{kInfinity, kInfinity, kInfinity, kInfinity};

    void set(int i, HalfPlane line) { a[i] = line.a.x, b[i] = line.a.y, c[i] = line.c; }
    HalfPlane line(int i) const { return {{a[i], b[i]}, c[i]}; }
    bool contains(Vec2 p) const {
      bool inside = true;
      for (int i = 0; i < kLines; ++i) inside &= a[i] * p.x + b[i] * p.y <= c[i];
      return inside;
    }
  };

  Vec3 s, t;  // orthonormal, in the tangent plane; sector 0 begins at s and runs towards t
  std::array<Sector, kSectors> sectors;
  float clearance = 0;  // [m] no boundary is nearer; may be too low, saves time if not

  /// The sector a point of the plane lies in.
  static int sector_of(Vec2 p) {
    constexpr std::array<int, 8> kOrder{0, 3, 7, 4, 1, 2, 6, 5};
    const int left = p.x < 0, below = p.y<0, steep = std::abs(p.y)> std::abs(p.x);
    return kOrder[left + 2 * below + 4 * steep];
  }

  bool contains(Vec2 p) const { return sectors[sector_of(p)].contains(p); }
  /// `offset`: from the query's position.
  bool contains(Vec3 offset) const { return contains(Vec2{dot(offset, s), dot(offset, t)}); }
};

}  // namespace octolux
