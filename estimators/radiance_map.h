// A photon map together with the estimator, neighbours and bandwidth that belong to it, so that the
// caustic map can never be read with the settings of the global one.
#pragma once

#include <cmath>
#include <utility>

#include "estimators/estimator.h"

namespace octolux {

class RadianceMap {
 public:
  RadianceMap() = default;
  RadianceMap(PhotonMap photons, const Estimator& estimator, const Bandwidth& bandwidth)
      : photons_(std::move(photons)), estimator_(&estimator), bandwidth_(bandwidth) {}

  bool empty() const { return photons_.size() == 0; }
  const PhotonMap& photons() const { return photons_; }
  const Bandwidth& bandwidth() const { return bandwidth_; }

  /// Radiance [W m^-2 sr^-1] leaving the point through its smooth lobes.
  Rgb radiance(const GatherPoint& at) const { return estimate(at).radiance; }

  /// What the kernel finds there, and the weight it gives a photon (Estimate).
  Estimate estimate(const GatherPoint& at) const {
    return empty() ? Estimate{} : estimator_->estimate(at, photons_, bandwidth_);
  }
  float k(float s) const { return estimator_->k(s); }

  /// The bandwidth [m] of a look-up of `neighbours` photons there.
  float bandwidth_at(const GatherPoint& at, int neighbours) const {
    thread_local NeighbourBuffer buffer;
    const auto wanted = static_cast<std::size_t>(neighbours) + 1;
    const std::span<const Neighbour> found =
        photons_.nearest(photon_query(at, bandwidth_), wanted, buffer);
    const bool full = found.size() == wanted;
    const float radius = full ? std::sqrt(found.back().distance2) : bandwidth_.max_radius;
    return radius * bandwidth_.shrink;
  }

 private:
  PhotonMap photons_;
  const Estimator* estimator_ = nullptr;
  Bandwidth bandwidth_;
};

}  // namespace octolux
