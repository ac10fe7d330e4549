// Which photons count at a query. Exact: the answer is that of the unpacked values, computed only
// as far as needed. One object serves one query of one thread (it remembers the last normal).
#pragma once

#include <cmath>
#include <cstdint>

#include "accel/photon_map.h"
#include "core/photon.h"

namespace octolux {

class PhotonFilter {
 public:
  explicit PhotonFilter(const PhotonQuery& query)
      : normal_(query.normal), max_segments_(query.max_segments), both_sides_(query.both_sides) {}

  bool operator()(const PhotonPayload& photon) {
    return surface_agrees(photon) && (both_sides_ || above(photon)) &&
           segments(photon) <= max_segments_;
  }

 private:
  /// Neighbours in a leaf mostly lie on one surface, so the answer for the last normal is kept.
  bool surface_agrees(const PhotonPayload& photon) {
    const std::uint32_t packed = photon.normal_segments >> 8;
    if (packed != last_packed_) {
      last_packed_ = packed;
      const float cosine = dot(normal(photon), normal_);
      last_agrees_ = (both_sides_ ? std::abs(cosine) : cosine) > kMinCosine;
    }
    return last_agrees_;
  }

  /// dot(wi, normal) > 0. Scaling `wi` to unit length matters to the sign only within rounding: the
  /// two dot products err by less than 4 half units in the last place of 1 each.
  bool above(const PhotonPayload& photon) const {
    constexpr float kRounding = 16 * 0x1p-24f;
    const float side = dot(unpack_octahedral(photon.wi, kWiBits), normal_);
    return std::abs(side) > kRounding ? side > 0 : dot(wi(photon), normal_) > 0;
  }

  static constexpr float kMinCosine = kFacingCosine;

  Vec3 normal_;
  int max_segments_;
  bool both_sides_;
  bool last_agrees_ = false;
  std::uint32_t last_packed_ = ~0u;  // no packed normal: those have 24 bits
};

}  // namespace octolux
