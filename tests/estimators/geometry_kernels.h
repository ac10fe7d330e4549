// Photons of constant irradiance on floors built by rooms.h, and look-ups among them.
#pragma once

#include <functional>
#include <memory>

#include "core/bsdf_adapters.h"
#include "core/bsdf_makers.h"
#include "core/texture.h"
#include "estimators/estimator.h"
#include "tests/estimators/rooms.h"
#include "tests/stats.h"

namespace octolux::test {

/// About `count` Poisson photons on the part of the square of side 2 `half` where `density(p)`, at
/// most 1, says so. Their flux makes the irradiance there density(p) [W per unit before the map].
inline PhotonMap floor_photons(const Room& room, Rng& rng, int count, float half,
                               const std::function<float(Vec2)>& density) {
  const Placement& map = room.placement();
  const float area = 4 * half * half * map.scale * map.scale;
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec2 u = rng.uniform2();
    const Vec2 p{half * (2 * u.x - 1), half * (2 * u.y - 1)};
    const float keep = rng.uniform();
    if (!(keep < density(p))) continue;
    Photon photon;
    photon.position = map.point({p.x, p.y, 0});
    photon.normal = photon.wi = map.vector({0, 0, 1});
    photon.flux = Rgb(area / static_cast<float>(count));
    photons.push_back(photon);
  }
  return PhotonMap(std::move(photons));
}

/// A white floor seen from `wo` (before the map).
class FloorLookUp {
 public:
  FloorLookUp(Room& room, Vec2 p, Vec3 wo = {0, 0, 1})
      : query_(query_at(room, p, 1, 0)),
        white_(make_diffuse(Color(Rgb(1)))),
        two_sided_(make_two_sided(*white_, *white_)),
        scattering_(query_.point, *two_sided_, room.placement().vector(normalize(wo)),
                    Carried::radiance),
        caster_(&room.caster()) {}

  /// The irradiance a kernel finds; radiance times pi.
  Estimate operator()(const Estimator& kernel, const PhotonMap& map, float turn,
                      const Bandwidth& bandwidth = {}) const {
    Estimate found = kernel.estimate({scattering_, 255, caster_, turn}, map, bandwidth);
    found.radiance *= kPi;
    return found;
  }
  /// The same without geometry.
  Estimate blind(const Estimator& kernel, const PhotonMap& map) const {
    Estimate found = kernel.estimate({scattering_}, map, {});
    found.radiance *= kPi;
    return found;
  }

 private:
  FeelerQuery query_;
  std::unique_ptr<Bsdf> white_, two_sided_;
  Scattering scattering_;
  const RayCaster* caster_;
};

}  // namespace octolux::test
