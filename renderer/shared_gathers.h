// What each pixel takes from its neighbours' gathers: the mean over those that know the same
// surface and are near enough (gather_sharing.h). Over four hundred neighbours of every pixel are
// asked in every sample, so what they gathered is laid out for eight to be asked at once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/gather_sharing.h"

namespace octolux {

/// Immutable, so thread-safe.
class SharedGathers {
 public:
  /// How far apart pixels may be that share: three vectors of eight reach across.
  static constexpr int kMostPixels = 11;

  /// Of pixels that share within `shrink` times their reach, if any do. Refers to what it is given.
  SharedGathers(const GatheredGrid& grid, const GatherSharing& sharing, float shrink);

  /// `radiance` of a diffuse pixel, averaged.
  Rgb shared(int x, int y) const;

 private:
  /// Position [m], shading normal, radiance, and SharingLimit::nearness.most().
  enum Field { px, py, pz, nx, ny, nz, red, green, blue, most, kFields };
  struct Weights;

  const SharingLimit& limit(const Gathered& gathered) const;
  void add(const Gathered& gathered, std::uint32_t kind, std::size_t i);
  void weigh(const Nearness& nearness, std::size_t i, Weights& weights) const;
  Rgb mean(Rgb own, std::size_t i, const Weights& weights) const;
  /// Of a pixel in the arrays, which have a margin on all sides.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y + kMostPixels) * stride_ +
           static_cast<std::size_t>(x + kMostPixels);
  }

  const GatheredGrid& grid_;
  const GatherSharing& sharing_;
  float shrink_;
  std::size_t stride_;
  std::array<std::vector<float>, kFields> of_;
  std::vector<std::uint32_t> kinds_;  // what it knows, as a number; 0: nothing to share
};

}  // namespace octolux
