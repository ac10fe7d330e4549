// How much a rough boundary reflects or transmits in all, tabulated over the cosine of the
// direction: what the layer below a rough coat receives. Computed at construction by Gauss-Legendre
// quadrature over the unit square that Microfacet::sample_visible maps to normals.
//
// The warp, the 64 equidistant cosines and the linear interpolation are those of Mitsuba 3's
// `roughplastic`, whose pictures ours are held against. Immutable, so thread-safe.
#pragma once

#include <algorithm>
#include <array>

#include "core/microfacet.h"

namespace octolux {

/// A function of the cosine in [0, 1], linear between 64 equidistant values.
class CosineTable {
 public:
  static constexpr int kSize = 64;

  CosineTable() = default;
  explicit CosineTable(const std::array<float, kSize>& values) : values_(values) {}

  /// The cosine of entry `i`; the first is not quite zero, where nothing is visible.
  static float cosine(int i) { return std::max(1e-6f, static_cast<float>(i) / (kSize - 1)); }

  float operator[](int i) const { return values_[static_cast<std::size_t>(i)]; }

  float operator()(float cosine) const {
    const float x = std::clamp(cosine, 0.0f, 1.0f) * (kSize - 1);
    const int i = std::min(static_cast<int>(x), kSize - 2);
    const float t = x - static_cast<float>(i);
    return (1 - t) * (*this)[i] + t * (*this)[i + 1];
  }

  /// Integral of 2 cos f(cos): the mean under uniform diffuse light. Exact for the table.
  float diffuse_mean() const;

 private:
  std::array<float, kSize> values_{};
};

/// Share of light that a rough dielectric boundary of index ratio `eta` (far side / near side) lets
/// through in one scattering.
CosineTable rough_transmittance(const Microfacet& microfacet, float eta);
/// Share it reflects back, likewise.
CosineTable rough_reflectance(const Microfacet& microfacet, float eta);

/// Directional albedo of a reflecting lobe with Schlick's Fresnel F0 + (F90 - F0) (1 - c)^5 is
/// F0 full + (F90 - F0) grazing.
struct SchlickAlbedo {
  CosineTable full;     // Fresnel factor 1
  CosineTable grazing;  // Fresnel factor (1 - c)^5
};
SchlickAlbedo schlick_albedo(const Microfacet& microfacet);

}  // namespace octolux
