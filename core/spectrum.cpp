// Integration of sampled spectra against the CIE tables. The sum runs over the same 1000
// equidistant wavelengths as Mitsuba 3's, and is divided by the same sum for a white spectrum, so
// the width of a step cancels. XYZ to Rec.709: ITU-R BT.709 primaries with D65 white, rounded as in
// Mitsuba.
#include "core/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/cie_tables.h"

namespace octolux {
namespace {

constexpr int kSteps = 1000;

double interpolate(const double (&table)[cie::kCount], double wavelength) {
  const double x = (wavelength - cie::kFirst) / cie::kStep;
  const int i = std::clamp(static_cast<int>(x), 0, cie::kCount - 2);
  return table[i] + (x - i) * (table[i + 1] - table[i]);
}

}  // namespace

double interpolate_spectrum(std::span<const SpectrumSample> samples, double wavelength) {
  if (wavelength < samples.front().wavelength || wavelength > samples.back().wavelength) return 0;
  const auto above = std::upper_bound(
      samples.begin() + 1, samples.end() - 1, wavelength,
      [](double w, const SpectrumSample& sample) { return w < sample.wavelength; });
  const SpectrumSample &a = *(above - 1), &b = *above;
  return a.value +
         (wavelength - a.wavelength) / (b.wavelength - a.wavelength) * (b.value - a.value);
}

Rgb xyz_to_rec709(double x, double y, double z) {
  return {static_cast<float>(3.240479 * x - 1.537150 * y - 0.498535 * z),
          static_cast<float>(-0.969256 * x + 1.875991 * y + 0.041556 * z),
          static_cast<float>(0.055648 * x - 0.204043 * y + 1.057311 * z)};
}

Rgb blackbody_radiance(double temperature) {
  constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23;  // SI, exact
  std::vector<SpectrumSample> samples;
  for (int nm = 360; nm <= 830; nm += 5) {
    const double m = nm * 1e-9;
    const double per_metre =
        2 * h * c * c / (std::pow(m, 5) * std::expm1(h * c / (m * k * temperature)));
    samples.push_back({static_cast<double>(nm), per_metre * 1e-9});
  }
  const Rgb rgb = spectrum_to_rgb(samples, SpectrumKind::emissive);
  return {std::max(rgb.r, 0.0f), std::max(rgb.g, 0.0f), std::max(rgb.b, 0.0f)};
}

Rgb spectrum_to_rgb(std::span<const SpectrumSample> samples, SpectrumKind kind) {
  double x = 0, y = 0, z = 0;
  double white = 0;  // luminance of a spectrum that is 1 everywhere
  for (int i = 0; i < kSteps; ++i) {
    const double w = cie::kFirst + i * (cie::kLast - cie::kFirst) / (kSteps - 1);
    const double light = kind == SpectrumKind::reflective ? interpolate(cie::kD65, w) : 1;
    const double value = light * interpolate_spectrum(samples, w);
    const double observed = interpolate(cie::kY, w);
    x += value * interpolate(cie::kX, w);
    y += value * observed;
    z += value * interpolate(cie::kZ, w);
    white += light * observed;
  }
  return xyz_to_rec709(x / white, y / white, z / white);
}

float srgb_to_linear(float encoded) {
  if (encoded <= 0.04045f) return encoded / 12.92f;
  return std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace octolux
