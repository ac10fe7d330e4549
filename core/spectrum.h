// Spectra given as wavelength:value lists, turned into linear Rec.709 by the CIE 1931 2-degree
// observer, in the way Mitsuba 3 does in its RGB variants: the list is interpolated linearly, is
// zero outside its range, and is integrated over 360 to 830 nm.
#pragma once

#include <span>

#include "core/rgb.h"

namespace octolux {

struct SpectrumSample {
  double wavelength = 0;  // [nm]
  double value = 0;
};

enum class SpectrumKind {
  /// Reflectance: seen under D65, so that 1 everywhere is (1, 1, 1).
  reflective,
  /// Emission: as it is, in units of an equal-energy spectrum of luminance 1. An equal-energy light
  /// is slightly pink in Rec.709, whose white is D65.
  emissive,
};

/// `samples`: at least two, wavelengths increasing. The result may lie outside [0, 1] (colours
/// that Rec.709 cannot show have a negative component).
Rgb spectrum_to_rgb(std::span<const SpectrumSample> samples, SpectrumKind kind);

/// A sampled spectrum at `wavelength` [nm]: linear in between, zero outside its range.
double interpolate_spectrum(std::span<const SpectrumSample> samples, double wavelength);

/// Radiance of a black body [W m^-2 sr^-1 nm^-1] (Planck 1900); temperature [K].
Rgb blackbody_radiance(double temperature);

/// CIE XYZ to linear Rec.709 with D65 white.
Rgb xyz_to_rec709(double x, double y, double z);

/// One sRGB component (IEC 61966-2-1) made linear.
float srgb_to_linear(float encoded);

}  // namespace octolux
