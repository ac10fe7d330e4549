// What the tests of records (renderer/record_sites.h, renderer/gather_records.h) have in common:
// photons on a floor.
#pragma once

#include <cmath>
#include <vector>

#include "core/rng.h"
#include "core/sampling.h"
#include "renderer/config.h"
#include "renderer/record_sites.h"

namespace octolux::test {

inline constexpr Vec3 kUp{0, 0, 1};
inline constexpr int kNeighbours = 20;
inline constexpr double kReuse = EyeConfig{}.reuse;

inline Rng rng_of(int use, int i) {
  return Rng(1, Stream::test, 810 + static_cast<std::uint64_t>(use), static_cast<std::uint64_t>(i));
}

/// Photons of flux 1 / count each on the unit square in z = 0, path lengths 1 and 2 in turn.
inline std::vector<Photon> on_square(int count, Rng rng) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec2 at = rng.uniform2();
    const Vec3 wi = sample_cosine_hemisphere(rng.uniform2());
    photons.push_back(
        {{at.x, at.y, 0}, wi, kUp, Rgb(1.0f / static_cast<float>(count)), 1 + i % 2, 0, kUp});
  }
  return photons;
}

inline std::vector<RecordSite> sites_at(const std::vector<Photon>& photons) {
  std::vector<RecordSite> sites;
  for (const Photon& p : photons) sites.push_back({p.position, p.normal, p.ns, p.error});
  return sites;
}

/// Photons on a floor of bars as wide as the gaps between them, and on the bars' sides.
inline std::vector<Photon> on_bars(int count, float width, Rng rng) {
  std::vector<Photon> photons = on_square(count, rng);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    Photon& p = photons[i];
    const float bar = 2 * width * std::floor(p.position.x / (2 * width));
    p.position.x = bar + width * rng.uniform();
    if (i % 3 == 0) continue;
    const float side = i % 3 == 1 ? 1.0f : -1.0f;
    p.position.x = bar + (side > 0 ? width : 0);
    p.position.z = -width * rng.uniform();
    p.normal = p.ns = {side, 0, 0};
  }
  return photons;
}

}  // namespace octolux::test
