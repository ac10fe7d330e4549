// The frame is that of the facing normal, the same for all look-ups on one plane. The squashed
// metric is never below the distance in the plane, so all points lie in the unit disc.
#include "estimators/plane_photons.h"

#include <algorithm>
#include <cmath>

namespace octolux {
namespace {

class Projection {
 public:
  Projection(const GatherPoint& at, const Disc& disc)
      : frame_(Frame::from_normal(at.at.facing_normal())),
        origin_(at.at.point().position),
        scale_(1 / std::sqrt(disc.r2)) {}

  Vec2 operator()(Vec3 p) const {
    const Vec3 d = (p - origin_) * scale_;
    return {dot(d, frame_.s), dot(d, frame_.t)};
  }

 private:
  Frame frame_;
  Vec3 origin_;
  float scale_;
};

}  // namespace

void project_photons(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                     PlanePoints& points) {
  const Projection projection(at, disc);
  points.resize(static_cast<int>(disc.photons.size()));
  int i = 0;
  for (const Neighbour& near : disc.photons) {
    points.set(i++, projection(map.position(near.photon)), near.distance2 < disc.h2);
  }
}

void project_inner_photons(const GatherPoint& at, const PhotonMap& map, const Disc& disc,
                           PlanePoints& points) {
  const Projection projection(at, disc);
  const auto is_inner = [&](const Neighbour& near) { return near.distance2 < disc.h2; };
  points.resize(
      static_cast<int>(std::count_if(disc.photons.begin(), disc.photons.end(), is_inner)));
  int i = 0;
  for (const Neighbour& near : disc.photons) {
    if (is_inner(near)) points.set(i++, projection(map.position(near.photon)), true);
  }
}

}  // namespace octolux
