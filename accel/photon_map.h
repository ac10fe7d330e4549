// The photons of one pass in a kd-tree: k nearest and all within a radius, exactly as brute force
// over the same photons would answer, ties included. Which photons count is decided inside the
// query (accel/photon_filter.h), so k of them really are k that count.
//
// Layout: accel/photon_tree.h, payloads apart in the same order; 28.5 bytes a photon. Immutable
// after construction, so thread-safe. The same photons in the same order give the same map whatever
// the number of threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/photon_region.h"
#include "accel/photon_tree.h"
#include "core/photon.h"

namespace octolux {

/// What counts as near, and which photons count at all.
struct PhotonQuery {
  Vec3 position;
  Vec3 normal;                      // geometric, unit, on the side of the viewer
  float max_radius = 1e30f;         // [m] in the squashed metric
  int max_segments = kMaxSegments;  // photons with longer paths do not count
  bool both_sides = false;          // count photons arriving from either side (smooth transmission)
  float squash = 3;  // >= 1; metric |d|^2 + (squash^2 - 1) (d . normal)^2 (Jensen 2002)
  const PhotonRegion* region = nullptr;  // if given, only photons above or below it count
};

/// A photon near a query's position.
struct Neighbour {
  float distance2 = 0;       // [m^2] squared, in the squashed metric
  std::uint32_t photon = 0;  // index in the map's own order
};
constexpr bool operator<(const Neighbour& a, const Neighbour& b) {
  return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.photon < b.photon);
}

/// Scratch space of one thread's queries; reused, so queries do not allocate.
struct NeighbourBuffer {
  std::vector<Neighbour> items;
};

class PhotonMap {
 public:
  PhotonMap() = default;
  /// Builds in parallel. Photons with a non-finite position, direction, normal or flux, or negative
  /// flux, are left out and counted.
  explicit PhotonMap(std::vector<Photon> photons);

  /// The k nearest photons that count, at a distance below max_radius, smallest k by (distance2,
  /// photon); fewer if there are fewer. Not sorted, except that the last one is the farthest.
  /// The span points into `buffer`.
  std::span<const Neighbour> nearest(const PhotonQuery& query, std::size_t k,
                                     NeighbourBuffer& buffer) const;
  /// All photons that count at a distance below query.max_radius, in the map's order.
  std::span<const Neighbour> within(const PhotonQuery& query, NeighbourBuffer& buffer) const;

  /// A guess at the distance of the k-th photon on surfaces that face about as `normal` does, from
  /// the leaves at `position` alone: right within a small factor where the density is even. Not 0
  /// unless photons coincide; infinite where there are none.
  float rough_distance(Vec3 position, Vec3 normal, std::size_t k) const;

  std::size_t size() const { return size_; }
  /// Photons are at indices below this, not all of which hold one.
  std::uint32_t slots() const { return tree_.slots(); }
  bool holds(std::uint32_t slot) const { return position(slot).x < kInfinity; }
  std::size_t rejected() const { return rejected_; }
  /// Bytes held, tree included.
  std::size_t memory() const;
  Vec3 position(std::uint32_t photon) const { return tree_.position(photon); }
  const PhotonTree& tree() const { return tree_; }
  const PhotonPayload* payloads() const { return payloads_.data(); }
  const PhotonPayload& payload(std::uint32_t photon) const { return payloads_[photon]; }
  Rgb flux(std::uint32_t photon) const { return unpack_flux(payloads_[photon].flux); }
  Vec3 wi(std::uint32_t photon) const { return octolux::wi(payloads_[photon]); }

 private:
  template <class Region>
  std::span<const Neighbour> nearest_in(Region region, const PhotonQuery& query, std::size_t k,
                                        NeighbourBuffer& buffer) const;
  template <class Region>
  std::span<const Neighbour> within_in(Region region, const PhotonQuery& query,
                                       NeighbourBuffer& buffer) const;

  PhotonTree tree_;
  std::vector<PhotonPayload> payloads_;  // in the tree's order
  std::size_t size_ = 0, rejected_ = 0;
};

}  // namespace octolux
