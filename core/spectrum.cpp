// Integration of sampled spectra against the CIE tables. The sum runs over the same 1000
// equidistant wavelengths as Mitsuba 3's, and is divided by the same sum for a white spectrum, so
// the width of a step cancels. XYZ to Rec.709: ITU-R BT.709 primaries with D65 white, rounded as in
// Mitsuba.
#include "core/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cie_tables.h"

namespace octolux {
namespace {

constexpr int kSteps = 1000;

double interpolate(const double (&table)[cie::kCount], double wavelength) {
  const double x = (wavelength - cie::kFirst) / cie::kStep;
  const int i = std::clamp(static_cast<int>(x), 0, cie::kCount - 2);
  return table[i] + (x - i) * (table[i + 1] - table[i]);
}

double interpolate(std::span<const SpectrumSample> samples, double wavelength) {
  if (wavelength < samples.front().wavelength || wavelength > samples.back().wavelength) return 0;
  const auto above = std::upper_bound(
      samples.begin() + 1, samples.end() - 1, wavelength,
      [](double w, const SpectrumSample& sample) { return w < sample.wavelength; });
  const SpectrumSample &a = *(above - 1), &b = *above;
  return a.value +
         (wavelength - a.wavelength) / (b.wavelength - a.wavelength) * (b.value - a.value);
}

struct Xyz {
  double x = 0, y = 0, z = 0;
};

Rgb to_rec709(Xyz c) {
  return {static_cast<float>(3.240479 * c.x - 1.537150 * c.y - 0.498535 * c.z),
          static_cast<float>(-0.969256 * c.x + 1.875991 * c.y + 0.041556 * c.z),
          static_cast<float>(0.055648 * c.x - 0.204043 * c.y + 1.057311 * c.z)};
}

}  // namespace

Rgb spectrum_to_rgb(std::span<const SpectrumSample> samples, SpectrumKind kind) {
  Xyz sum;
  double white = 0;  // luminance of a spectrum that is 1 everywhere
  for (int i = 0; i < kSteps; ++i) {
    const double w = cie::kFirst + i * (cie::kLast - cie::kFirst) / (kSteps - 1);
    const double light = kind == SpectrumKind::reflective ? interpolate(cie::kD65, w) : 1;
    const double value = light * interpolate(samples, w);
    const double y = interpolate(cie::kY, w);
    sum.x += value * interpolate(cie::kX, w);
    sum.y += value * y;
    sum.z += value * interpolate(cie::kZ, w);
    white += light * y;
  }
  return to_rec709({sum.x / white, sum.y / white, sum.z / white});
}

float srgb_to_linear(float encoded) {
  if (encoded <= 0.04045f) return encoded / 12.92f;
  return std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace octolux
