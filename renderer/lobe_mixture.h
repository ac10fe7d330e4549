// A density over directions that gather rays can follow: a weighted sum of lobes.
//
// Lobes are spherical Cauchy distributions (Kato & McCullagh, arXiv:1510.07679, 2020): density,
// normalisation and sampling are rational functions, no exp or log; and their tails are heavy, so
// a lobe never claims that its neighbourhood is dark.
#pragma once

#include <array>
#include <cstddef>

#include "core/vec.h"

namespace octolux {

/// No allocation. Lobes may reach below a surface's horizon.
class LobeMixture {
 public:
  static constexpr std::size_t kMost = 64;  // lobes

  LobeMixture() {}  // of none: there is nothing to sample. Leaves the arrays as they are
  /// A lobe around the unit vector `axis` with density (1 + 2k) / (4 pi (1 + k t)^2) [sr^-1], k
  /// being its sharpness and t = 1 - cos of the angle to the axis: the median of t is 1 / (1 + k).
  /// All shares must sum to 1.
  void add(Vec3 axis, float sharpness, float share);

  bool empty() const { return count_ == 0; }
  /// Density [sr^-1] of `sample`; 0 if empty.
  float pdf_w(Vec3 wi) const;
  /// A direction. `u` uniform in [0, 1)^2. Must not be empty.
  Vec3 sample(Vec2 u) const;

 private:
  static constexpr std::size_t kLanes = 8;  // lobes looked at together
  using PerLobe = std::array<float, kMost>;

  std::size_t count_ = 0;
  alignas(32) PerLobe x_, y_, z_;  // axes
  alignas(32) PerLobe sharpness_;
  alignas(32) PerLobe peak_;  // share (1 + 2k) / (4 pi); 0 from count_ to the next whole eight
  PerLobe share_;
};

}  // namespace octolux
