// Spectra to Rec.709. Expected colours of white and of an equal-energy light follow from the
// chromaticities of D65 and E; the tables' 5 nm steps leave an error of some 1e-4.
#include "core/spectrum.h"

#include <gtest/gtest.h>

#include <vector>

namespace octolux {
namespace {

constexpr float kTableError = 1e-3f;

void expect_near(Rgb a, Rgb b, float tolerance) {
  EXPECT_NEAR(a.r, b.r, tolerance);
  EXPECT_NEAR(a.g, b.g, tolerance);
  EXPECT_NEAR(a.b, b.b, tolerance);
}

TEST(Spectrum, WhiteReflectanceIsWhite) {
  const std::vector<SpectrumSample> white{{360, 1}, {830, 1}};
  expect_near(spectrum_to_rgb(white, SpectrumKind::reflective), {1, 1, 1}, kTableError);
}

TEST(Spectrum, EqualEnergyLightHasTheColourOfE) {
  // XYZ = (1, 1, 1) times the rows of the XYZ to Rec.709 matrix.
  const std::vector<SpectrumSample> light{{360, 1}, {830, 1}};
  expect_near(spectrum_to_rgb(light, SpectrumKind::emissive), {1.2048f, 0.9483f, 0.9089f},
              kTableError);
}

TEST(Spectrum, MatchesTheCornellLightOfMitsubaReferences) {
  // Colour ratios measured in mitsuba-data's bsdf_spheres/refs/test_arealight_ref_rgb.exr, on grey
  // metal: red/green 1.90802 and blue/green 0.255297, to the noise of the picture.
  const std::vector<SpectrumSample> lamp{{400, 0}, {500, 8}, {600, 15.6}, {700, 18.4}};
  const Rgb c = spectrum_to_rgb(lamp, SpectrumKind::emissive);
  EXPECT_NEAR(c.r / c.g, 1.90802f, 1e-4f);
  EXPECT_NEAR(c.b / c.g, 0.255297f, 1e-5f);
}

TEST(Spectrum, IsLinear) {
  const std::vector<SpectrumSample> a{{400, 1}, {550, 3}, {700, 0}};
  const std::vector<SpectrumSample> b{{400, 2}, {550, 6}, {700, 0}};
  const Rgb x = spectrum_to_rgb(a, SpectrumKind::emissive);
  const Rgb y = spectrum_to_rgb(b, SpectrumKind::emissive);
  expect_near(x * 2, y, 1e-6f);
}

TEST(Spectrum, IsZeroOutsideItsRange) {
  const std::vector<SpectrumSample> infrared{{900, 1}, {1000, 1}};
  EXPECT_TRUE(is_black(spectrum_to_rgb(infrared, SpectrumKind::emissive)));
  const std::vector<SpectrumSample> narrow{{610, 1}, {640, 1}};
  const Rgb red = spectrum_to_rgb(narrow, SpectrumKind::emissive);
  EXPECT_GT(red.r, 0);
  EXPECT_LT(red.g, red.r / 4);
  EXPECT_NEAR(red.b, 0, 0.05f * red.r);
}

TEST(Spectrum, DecodesSrgb) {
  EXPECT_EQ(srgb_to_linear(0), 0);
  EXPECT_FLOAT_EQ(srgb_to_linear(1), 1);
  EXPECT_NEAR(srgb_to_linear(0.5f), 0.21404f, 1e-5f);  // IEC 61966-2-1
  EXPECT_NEAR(srgb_to_linear(0.04f), 0.04f / 12.92f, 1e-8f);
}

}  // namespace
}  // namespace octolux
