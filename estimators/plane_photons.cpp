// The frame is that of the facing normal, the same for all look-ups on one plane. The squashed
// metric is never below the distance in the plane, so all points lie in the unit disc.
#include "estimators/plane_photons.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "estimators/radial.h"

namespace octolux {
namespace {

/// The axes of the tangent plane, in units of the look-up's radius.
struct Axes {
  Vec3 origin, s, t;

  Axes(const GatherPoint& at, const Disc& disc) : origin(at.at.point().position) {
    const Frame frame = Frame::from_normal(at.at.facing_normal());
    const float scale = 1 / std::sqrt(disc.r2);
    s = frame.s * scale;
    t = frame.t * scale;
  }
};

/// Writes a group's points and whether they are inside; lanes without a photon are at the origin.
__attribute__((always_inline)) inline void project(const PhotonMap& map, const PhotonGroup& group,
                                                   const Axes& axes, Mask8 inside,
                                                   PlanePoints& points, std::size_t i) {
  constexpr std::uint32_t kNext = PhotonTree::kBlockSize;
  const float* coordinates = map.tree().coordinates();
  const Mask8 offset = PhotonTree::coordinate_offset(group.photon);
  const Float8 x = gather8(coordinates, offset) - axes.origin.x;
  const Float8 y = gather8(coordinates + kNext, offset) - axes.origin.y;
  const Float8 z = gather8(coordinates + 2 * kNext, offset) - axes.origin.z;
  const Mask8 there = group.distance2 < kInfinity;
  const Float8 u = x * axes.s.x + y * axes.s.y + z * axes.s.z;
  const Float8 v = x * axes.t.x + y * axes.t.y + z * axes.t.z;
  store8(points.x() + i, there ? u : splat8(0));
  store8(points.y() + i, there ? v : splat8(0));
  store8(points.inside() + i, ones8(inside));
}

}  // namespace

Estimate sum_and_project(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                         PlanePoints& points) {
  const std::optional<Rgb> reflectance = at.at.lambertian();
  if (!reflectance) {
    project_photons(at, map, disc, points);
    return radial_sum(at, map, disc, FlatKernel{});
  }
  const Axes axes(at, disc);
  points.start(static_cast<int>(disc.photons.size()));
  FluxSum sum;
  Mask8 count{};
  for (std::size_t i = 0; i < disc.photons.size(); i += 8) {
    const PhotonGroup group = photon_group(disc.photons, i);
    const Mask8 inside = group.distance2 < disc.h2;
    sum.add(group.fluxes(map, 0, inside));
    sum.add(group.fluxes(map, 1, inside));
    count -= inside;
    project(map, group, axes, inside, points, i);
  }
  return flat_estimate(sum.total(), sum8(count), disc, *reflectance);
}

void project_photons(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                     PlanePoints& points) {
  const Axes axes(at, disc);
  points.start(static_cast<int>(disc.photons.size()));
  for (std::size_t i = 0; i < disc.photons.size(); i += 8) {
    const PhotonGroup group = photon_group(disc.photons, i);
    project(map, group, axes, group.distance2 < disc.h2, points, i);
  }
}

void project_inner_photons(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                           PlanePoints& points) {
  thread_local std::vector<Neighbour> inner;
  inner.clear();
  std::copy_if(disc.photons.begin(), disc.photons.end(), std::back_inserter(inner),
               [&](const Neighbour& near) { return near.distance2 < disc.h2; });
  project_photons(at, map, {inner, disc.h2, disc.r2}, points);
}

}  // namespace octolux
