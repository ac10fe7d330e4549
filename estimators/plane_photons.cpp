// The frame is that of the facing normal, the same for all look-ups on one plane. The squashed
// metric is never below the distance in the plane, so all points lie in the unit disc.
#include "estimators/plane_photons.h"

#include <algorithm>
#include <cmath>

namespace octolux {
namespace {

/// Gathers the photons that `counts` says, relative to the query, and projects them.
template <class Counts>
void project(const GatherPoint& at, const PhotonMap& map, const Disc& disc, PlanePoints& points,
             Counts&& counts) {
  thread_local PlanePoints::Positions positions;
  positions.resize(static_cast<int>(disc.photons.size()));
  float* x = positions.x.data();
  float* y = positions.y.data();
  float* z = positions.z.data();
  float* distance2 = positions.distance2.data();
  const Vec3 origin = at.at.point().position;
  int count = 0;
  for (const Neighbour& near : disc.photons) {
    if (!counts(near)) continue;
    const Vec3 p = map.position(near.photon);
    x[count] = p.x - origin.x;
    y[count] = p.y - origin.y;
    z[count] = p.z - origin.z;
    distance2[count] = near.distance2;
    ++count;
  }
  const Frame frame = Frame::from_normal(at.at.facing_normal());
  const float scale = 1 / std::sqrt(disc.r2);
  points.project(positions, count, frame.s * scale, frame.t * scale, disc.h2);
}

}  // namespace

void project_photons(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                     PlanePoints& points) {
  project(at, map, disc, points, [](const Neighbour&) { return true; });
}

void project_inner_photons(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                           PlanePoints& points) {
  project(at, map, disc, points, [&](const Neighbour& near) { return near.distance2 < disc.h2; });
}

}  // namespace octolux
