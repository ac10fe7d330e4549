// Colours, heat maps, words and sheets of `octolux compare`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/tools/pictures.h"
#include "tools/compare/colour_map.h"
#include "tools/compare/flip_colour.h"
#include "tools/compare/heat_map.h"
#include "tools/compare/sheet.h"
#include "tools/compare/text.h"

namespace octolux {
namespace {

using test::constant;
using test::picture;

struct Lab {
  double l, a, b;
};

/// CIELAB of an sRGB colour: the Hunt adjustment taken back.
Lab lab_of(Rgb srgb) {
  const flip::Triple lab = flip::linear_to_hunt_lab(
      {flip::srgb_to_linear(srgb.r), flip::srgb_to_linear(srgb.g), flip::srgb_to_linear(srgb.b)});
  const double scale = 100 / static_cast<double>(lab.a);
  return {lab.a, scale * lab.b, scale * lab.c};
}

double delta_e(Rgb p, Rgb q) {
  const Lab a = lab_of(p), b = lab_of(q);
  return std::hypot(a.l - b.l, a.a - b.a, a.b - b.b);
}

/// Machado, Oliveira & Fernandes 2009, severity 1: linear RGB as people without red (protan) or
/// green (deutan) cones see it.
struct Eye {
  float m[3][3];
};
constexpr Eye kProtan = {{{0.152286f, 1.052583f, -0.204868f},
                          {0.114503f, 0.786281f, 0.099216f},
                          {-0.003882f, -0.048116f, 1.051998f}}};
constexpr Eye kDeutan = {{{0.367322f, 0.860646f, -0.227968f},
                          {0.280085f, 0.672501f, 0.047413f},
                          {-0.011820f, 0.042940f, 0.968881f}}};

Rgb as_seen(Rgb srgb, const Eye& eye) {
  const float v[3] = {flip::srgb_to_linear(srgb.r), flip::srgb_to_linear(srgb.g),
                      flip::srgb_to_linear(srgb.b)};
  const auto channel = [&](int i) {
    const float linear = eye.m[i][0] * v[0] + eye.m[i][1] * v[1] + eye.m[i][2] * v[2];
    return flip::linear_to_srgb(std::clamp(linear, 0.0f, 1.0f));
  };
  return {channel(0), channel(1), channel(2)};
}

/// Equal steps look equal; clipping at the gamut's edge would break that.
TEST(ColourMaps, StepsAreUniform) {
  for (const ColourMap& map : {ColourMap::diverging(), ColourMap::sequential()}) {
    const auto& c = map.colours();
    ASSERT_EQ(c.size(), 255u);
    const double step = delta_e(c[0], c[1]);
    for (std::size_t i = 1; i < c.size(); ++i) {
      // Floats carry colours to 1e-6; in L*a*b* that is up to 500 * 1e-6 / 0.01^(2/3).
      EXPECT_NEAR(delta_e(c[i - 1], c[i]), step, 0.01) << i;
    }
  }
}

TEST(ColourMaps, SidesAreToldApartByTheColourBlind) {
  const ColourMap map = ColourMap::diverging();
  for (const Eye& eye : {kProtan, kDeutan}) {
    for (const float t : {0.1f, 0.25f, 0.5f}) {
      const Rgb low = as_seen(map(0.5f - t), eye), high = as_seen(map(0.5f + t), eye);
      // A just noticeable difference is about 2.3 (Mahy et al. 1994).
      EXPECT_GT(delta_e(low, high), 2 * 2.3) << t;
      EXPECT_GT(lab_of(high).b, lab_of(low).b) << t;
    }
    EXPECT_GT(delta_e(as_seen(map(0), eye), as_seen(map(1), eye)), 40);
  }
  EXPECT_NEAR(lab_of(map(0)).l, lab_of(map(1)).l, 0.1);
}

TEST(ColourMaps, SequentialGetsLighterForEveryEye) {
  const auto colours = ColourMap::sequential().colours();
  for (std::size_t i = 1; i < colours.size(); ++i) {
    EXPECT_GT(lab_of(colours[i]).l, lab_of(colours[i - 1]).l) << i;
    EXPECT_GT(lab_of(as_seen(colours[i], kDeutan)).l, lab_of(as_seen(colours[i - 1], kDeutan)).l);
  }
}

TEST(HeatMap, ItsSquareIsTheRelativeSquareErrorOfLuminance) {
  const NamedPicture y = picture("y", constant(3, 1, Rgb(0.5f)));
  Image image = constant(3, 1, Rgb(0.75f));
  image.at(1, 0) = Rgb(0.5f);
  image.at(2, 0).g = std::numeric_limits<float>::infinity();
  const NamedPicture x = picture("x", image);
  const ScalarField d = relative_difference(view_layer(y), view_layer(x));
  EXPECT_NEAR(d.values[0], 0.25 / std::sqrt(0.26), 1e-6);
  EXPECT_EQ(d.values[1], 0);
  EXPECT_TRUE(std::isnan(d.values[2]));
  const Image shown = colour_field(d, ColourMap::diverging(), -1, 1);
  EXPECT_EQ(shown.at(1, 0), ColourMap::diverging()(0.5f));
  EXPECT_EQ(shown.at(2, 0), kNotANumberColour);
  EXPECT_GT(shown.at(0, 0).r, shown.at(0, 0).b);  // too bright is orange
}

TEST(HeatMap, RangesAreRoundAndHoldNearlyAll) {
  ScalarField field{1000, 1, std::vector<float>(1000, 0.03f)};
  for (int i = 0; i < 9; ++i) field.values[i] = -7;
  EXPECT_DOUBLE_EQ(heat_map_range(std::vector{field}), 0.05);
  field.values[9] = field.values[10] = -7;
  EXPECT_DOUBLE_EQ(heat_map_range(std::vector{field}), 10);
  EXPECT_DOUBLE_EQ(heat_map_range(std::vector{ScalarField{2, 1, {0, 0}}}), 0.001);
}

TEST(HeatMap, ShrinkingAveragesSquaresAndRests) {
  const Image image = test::paint(5, 3, [](int x, int y) { return Rgb(float(x + 10 * y)); });
  const Image half = shrink(image, 2);
  ASSERT_EQ(half.width, 3);
  ASSERT_EQ(half.height, 2);
  EXPECT_EQ(half.at(0, 0).r, 5.5f);   // 0 1 10 11
  EXPECT_EQ(half.at(2, 0).g, 9.0f);   // 4 14
  EXPECT_EQ(half.at(2, 1).b, 24.0f);  // 24
  EXPECT_EQ(enlarge(image, 3).at(14, 8), image.at(4, 2));
  EXPECT_EQ(shrink_factor(3840, 2160, 2e6), 3);
  EXPECT_EQ(shrink_factor(100, 100, 1e4), 1);
}

/// Dark pixels of a picture.
int ink(const Image& image) {
  return static_cast<int>(
      std::count_if(image.pixels.begin(), image.pixels.end(), [](Rgb p) { return p.r < 0.5f; }));
}

TEST(Text, LettersAreDrawnScaledAndCutAtTheBorder) {
  Image small = constant(60, 20, Rgb(1)), large = constant(120, 40, Rgb(1));
  draw_text(small, 2, 2, "Leak 5 %", {1});
  draw_text(large, 4, 4, "Leak 5 %", {2});
  EXPECT_GT(ink(small), 50);
  EXPECT_EQ(ink(large), 4 * ink(small));
  EXPECT_EQ(text_width("Leak", 3), 3 * text_width("Leak", 1));
  Image tiny = constant(5, 5, Rgb(1));
  draw_text(tiny, -3, -3, "MMMM\xc3\xa4", {4});  // must stay inside
  EXPECT_LE(text_width(fit_text("a/long/path/to.exr", 60, 1), 1), 60);
  EXPECT_TRUE(fit_text("a/long/path/to.exr", 60, 1).ends_with("to.exr"));
}

TEST(Sheet, HoldsEveryPanelTitleAndTheScale) {
  const Image grey = constant(200, 100, Rgb(0.6f));
  const std::vector<Panel> panels = {{"one", grey, {"relMSE 1"}}, {"two", grey, {}}};
  const Image plain = make_sheet("title", panels);
  const auto greys = [&](const Image& sheet) {
    return std::count(sheet.pixels.begin(), sheet.pixels.end(), Rgb(0.6f));
  };
  EXPECT_EQ(greys(plain), 2 * 4 * 200 * 100);  // enlarged by two
  EXPECT_GT(ink(plain), 100);                  // words: title, two names, a remark
  const Image scaled =
      make_sheet("title", panels, ScaleBar{ColourMap::diverging(), -0.5, 0.5, " %", 0.01, "d"});
  EXPECT_EQ(greys(scaled), greys(plain));
  EXPECT_GT(scaled.height, plain.height);
  EXPECT_NE(std::find(scaled.pixels.begin(), scaled.pixels.end(), ColourMap::diverging()(1)),
            scaled.pixels.end());
}

}  // namespace
}  // namespace octolux
