// FLIP against published colours and exposures, closed forms, and a plain implementation after the
// papers: in double, with filters that are not separated.
#include "tools/compare/flip.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "core/image_io.h"
#include "core/parallel.h"
#include "tests/tools/pictures.h"
#include "tools/compare/flip_colour.h"

namespace octolux {
namespace {

using test::constant;
using test::paint;

constexpr double kPi = std::numbers::pi;
constexpr double kPpd = kFlipPixelsPerDegree;

using Colour = std::array<double, 3>;
using Weights = std::vector<std::vector<double>>;

/// Rec.709 to XYZ over white, by the standard's chromaticities and D65 (IEC 61966-2-1).
constexpr double kXyz[3][3] = {{0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047},
                               {0.2126729, 0.7151522, 0.0721750},
                               {0.0193339 / 1.08883, 0.1191920 / 1.08883, 0.9503041 / 1.08883}};

Colour relative_xyz(const Colour& rgb) {
  Colour xyz{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) xyz[i] += kXyz[i][j] * rgb[j];
  }
  return xyz;
}

double determinant(const Colour& a, const Colour& b, const Colour& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// By Cramer's rule on the columns.
Colour linear_of(const Colour& xyz) {
  const auto column = [](int j) { return Colour{kXyz[0][j], kXyz[1][j], kXyz[2][j]}; };
  const Colour r = column(0), g = column(1), b = column(2);
  const double d = determinant(r, g, b);
  return {determinant(xyz, g, b) / d, determinant(r, xyz, b) / d, determinant(r, g, xyz) / d};
}

Colour hunt_lab(const Colour& rgb) {
  const Colour xyz = relative_xyz(rgb);
  const auto f = [](double t) {
    const double d = 6.0 / 29;
    return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
  };
  const double l = 116 * f(xyz[1]) - 16;
  return {l, 5 * l * (f(xyz[0]) - f(xyz[1])), 2 * l * (f(xyz[1]) - f(xyz[2]))};
}

double colour_error(const Colour& a, const Colour& b) {
  const auto power = [](const Colour& p, const Colour& q) {
    return std::pow(std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]), 0.7);
  };
  const double most = power(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), e = power(a, b);
  const double knee = 0.4 * most;
  return e < knee ? 0.95 * e / knee : 0.95 + 0.05 * (e - knee) / (most - knee);
}

/// weight(x, y) over a square of `radius`.
Weights weights(int radius, const std::function<double(int, int)>& weight) {
  Weights w(2 * radius + 1, std::vector<double>(2 * radius + 1));
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) w[y + radius][x + radius] = weight(x, y);
  }
  return w;
}

/// Positive weights sum to 1, negative ones to -1.
Weights balanced(Weights w) {
  double positive = 0, negative = 0;
  for (const auto& row : w) {
    for (const double v : row) (v > 0 ? positive : negative) += std::abs(v);
  }
  for (auto& row : w) {
    for (double& v : row) v /= v > 0 ? positive : negative > 0 ? negative : 1;
  }
  return w;
}

struct Gaussians {
  double a1, b1, a2, b2;
};

Weights contrast(const Gaussians& g) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * kPpd));
  return balanced(weights(radius, [&](int x, int y) {
    const double d2 = (x * x + y * y) / (kPpd * kPpd);
    const auto term = [&](double a, double b) {
      return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * d2 / b);
    };
    return term(g.a1, g.b1) + (g.a2 > 0 ? term(g.a2, g.b2) : 0);
  }));
}

using Field = std::function<double(int, int)>;

double filtered(const Field& field, const Weights& w, int x, int y) {
  const int radius = static_cast<int>(w.size()) / 2;
  double sum = 0;
  for (int j = -radius; j <= radius; ++j) {
    for (int i = -radius; i <= radius; ++i) {
      sum += w[j + radius][i + radius] * field(x + i, y + j);
    }
  }
  return sum;
}

/// One picture (linear light) as FLIP sees pixel (x, y).
struct Seen {
  Colour lab;
  double edge, point;
};

Seen see(const Image& image, int x, int y) {
  const auto xyz = [&](int i, int j) {
    const Rgb p = image.at(std::clamp(i, 0, image.width - 1), std::clamp(j, 0, image.height - 1));
    return relative_xyz({double{p.r}, double{p.g}, double{p.b}});
  };
  const Field luma = [&](int i, int j) { return xyz(i, j)[1]; };
  const Field red_green = [&](int i, int j) { return xyz(i, j)[0] - xyz(i, j)[1]; };
  const Field blue_yellow = [&](int i, int j) { return xyz(i, j)[1] - xyz(i, j)[2]; };
  static const Weights a = contrast({1, 0.0047, 0, 1}), rg = contrast({1, 0.0053, 0, 1}),
                       by = contrast({34.1, 0.04, 13.5, 0.025});
  const double f = filtered(luma, a, x, y);
  Colour rgb =
      linear_of({f + filtered(red_green, rg, x, y), f, f - filtered(blue_yellow, by, x, y)});
  for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);

  const double s = 0.5 * 0.082 * kPpd;
  const int radius = static_cast<int>(std::ceil(3 * s));
  const auto g = [&](int i, int j) { return std::exp(-(i * i + j * j) / (2 * s * s)); };
  static const Weights edge = balanced(weights(radius, [&](int i, int j) { return -i * g(i, j); }));
  static const Weights point =
      balanced(weights(radius, [&](int i, int j) { return (i * i / (s * s) - 1) * g(i, j); }));
  const Field turned = [&](int i, int j) { return luma(x + j - y, y + i - x); };
  return {hunt_lab(rgb), std::hypot(filtered(luma, edge, x, y), filtered(turned, edge, x, y)),
          std::hypot(filtered(luma, point, x, y), filtered(turned, point, x, y))};
}

double plain_flip(const Image& reference, const Image& image, int x, int y) {
  const Seen r = see(reference, x, y), t = see(image, x, y);
  const double feature =
      std::max(std::abs(r.edge - t.edge), std::abs(r.point - t.point)) / std::sqrt(2.0);
  return std::pow(colour_error(r.lab, t.lab), 1 - std::sqrt(feature));
}

Image linear_image(Image shown) {
  for (Rgb& p : shown.pixels) {
    p = {flip::srgb_to_linear(p.r), flip::srgb_to_linear(p.g), flip::srgb_to_linear(p.b)};
  }
  return shown;
}

/// Lines, dots, a gradient and colours.
Image scene(bool changed) {
  return paint(48, 40, [&](int x, int y) -> Rgb {
    if (x == 12 || y == (changed ? 31 : 30)) return {0.9f, 0.8f, 0.1f};
    if (x == 30 && y == 10) return Rgb(changed ? 1.f : 0.f);
    const float g = static_cast<float>(x) / 48;
    return {g, changed ? 0.5f * g : 0.4f * g, (x / 8 + y / 8) % 2 ? 0.7f : 0.2f};
  });
}

/// L*a*b* of sRGB's primaries under D65 (B. Lindbloom's calculator): green 87.7347
/// -86.1827 83.1793, blue 32.2970 79.1875 -107.8602. The two pictures' matrices differ in the fifth
/// digit.
TEST(Flip, GreenAndBlueHaveTheirPublishedColours) {
  const flip::Triple green = flip::linear_to_hunt_lab({0, 1, 0});
  EXPECT_NEAR(green.a, 87.7347, 0.01);
  EXPECT_NEAR(green.b, 0.877347 * -86.1827, 0.02);
  EXPECT_NEAR(green.c, 0.877347 * 83.1793, 0.02);
  const flip::Triple blue = flip::linear_to_hunt_lab({0, 0, 1});
  EXPECT_NEAR(blue.a, 32.2970, 0.01);
  EXPECT_NEAR(blue.b, 0.322970 * 79.1875, 0.02);
  EXPECT_NEAR(blue.c, 0.322970 * -107.8602, 0.02);
}

/// The paper scales its colour difference so that green against blue is 1.
TEST(Flip, GreenAgainstBlueIsTheLargestDifference) {
  const Image green = constant(32, 32, {0, 1, 0}), blue = constant(32, 32, {0, 0, 1});
  for (const float e : ldr_flip(green, blue).error) EXPECT_NEAR(e, 1, 1e-4);
}

/// Without features FLIP is the colour difference of what was shown: no filter changes a constant.
TEST(Flip, ConstantPicturesHaveAClosedForm) {
  const Image white = constant(24, 24, Rgb(1)), black = constant(24, 24, Rgb(0));
  const double most = std::pow(203.3, 0.7);  // |dL| + chroma of the colours above
  const double e = std::pow(100.0, 0.7);
  const double expected = 0.95 + 0.05 * (e - 0.4 * most) / (0.6 * most);
  EXPECT_NEAR(ldr_flip(white, black).mean(), expected, 1e-4);
  EXPECT_EQ(ldr_flip(white, white).mean(), 0);
}

TEST(Flip, AgreesWithThePlainImplementation) {
  const Image a = scene(false), b = scene(true);
  const FlipMap map = ldr_flip(a, b);
  const Image linear_a = linear_image(a), linear_b = linear_image(b);
  for (int y = 0; y < a.height; y += 5) {
    for (int x = 0; x < a.width; x += 3) {
      // The square root of a feature difference near 0 magnifies floats' rounding, 1e-7, to 3e-4.
      EXPECT_NEAR(map.error[y * a.width + x], plain_flip(linear_a, linear_b, x, y), 1e-3)
          << x << ' ' << y;
    }
  }
}

TEST(Flip, IsSymmetricAndBlindToThreads) {
  const Image a = scene(false), b = scene(true);
  const auto run = [&](int threads, const Image& y, const Image& x) {
    const ThreadLimit limit(threads);
    return ldr_flip(y, x).error;
  };
  EXPECT_EQ(run(1, a, b), run(7, a, b));
  EXPECT_EQ(run(2, a, b), run(2, b, a));
}

/// The means the authors' own tests expect of the pictures in their repository (NVlabs/flip, folder
/// images), which are not ours to ship.
TEST(Flip, AuthorsPicturesHaveThePublishedMeans) {
  const char* folder = std::getenv("OCTOLUX_FLIP_IMAGES");
  if (!folder) GTEST_SKIP() << "set OCTOLUX_FLIP_IMAGES to the folder images of NVlabs/flip";
  const auto load = [&](const std::string& name) {
    return read_image(std::string(folder) + "/" + name, Encoding::linear);
  };
  // Given to six digits, and their implementations differ in the sixth.
  EXPECT_NEAR(ldr_flip(load("reference.png"), load("test.png")).mean(), 0.159691, 1e-5);
  EXPECT_NEAR(hdr_flip(load("reference.exr"), load("test.exr")).mean(), 0.283478, 1e-5);
}

/// The authors' test picture runs from -12.5423 to 0.9427 stops in 14 exposures.
TEST(Flip, ExposuresAreCountedAsPublished) {
  EXPECT_EQ(flip_exposure_count(-12.5423, 0.9427), 14);
  EXPECT_EQ(flip_exposure_count(1, 1.5), 2);
}

/// Start and stop bring brightest and median to 0.85 in Narkowicz's curve, the original of which
/// has the exposure 0.6 inside.
TEST(Flip, ExposuresReachTheirTarget) {
  const Image image = paint(9, 9, [](int x, int y) { return Rgb(x + y == 0 ? 64.f : 0.25f); });
  const FlipExposures e = flip_exposures(image);
  const auto narkowicz = [](double v) {
    const double x = 0.6 * v;
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  };
  EXPECT_NEAR(narkowicz(64 * std::exp2(e.start)), 0.85, 1e-6);
  EXPECT_NEAR(narkowicz(0.25 * std::exp2(e.stop)), 0.85, 1e-6);
  EXPECT_EQ(e.count, 8);
  EXPECT_EQ(flip_exposures(Image(4, 4)).count, 1);
}

/// HDR-FLIP is the worst of its exposures: of constant grey, the colour error by hand.
TEST(Flip, HdrTakesTheWorstExposure) {
  const Image y = constant(16, 16, Rgb(0.5f)), x = constant(16, 16, Rgb(0.4f));
  const FlipExposures exposures{-2, 2, 5};
  double worst = 0;
  for (int stop = -2; stop <= 2; ++stop) {
    const auto shown = [&](double v) {
      const double t = 0.6 * v * std::exp2(stop);
      const double s = t * (2.51 * t + 0.03) / (t * (2.43 * t + 0.59) + 0.14);
      return hunt_lab({s, s, s});
    };
    worst = std::max(worst, colour_error(shown(0.5), shown(0.4)));
  }
  EXPECT_NEAR(hdr_flip(y, x, exposures, kPpd).mean(), worst, 1e-4);
}

TEST(Flip, WhatIsNotFiniteDoesNotSpread) {
  Image x = scene(true);
  x.at(3, 3) = Rgb(std::numeric_limits<float>::infinity());
  x.at(40, 3) = Rgb(std::numeric_limits<float>::quiet_NaN());
  for (const float e : hdr_flip(scene(false), x).error) EXPECT_TRUE(e >= 0 && e <= 1) << e;
}

}  // namespace
}  // namespace octolux
