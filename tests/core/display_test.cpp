// From light to screen: the shipped views against their formulas, and legal names.
#include "core/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "tests/temporary_folder.h"

namespace octolux {
namespace {

/// IEC 61966-2-1, in double.
double srgb(double v) {
  const double c = std::min(std::max(v, 0.0), 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

/// OpenColorIO joins line and power where value and slope agree, which moves the line's slope from
/// 12.92 to 12.9232 and the joint from 0.0031308 to 0.0030399: together less than 1.5e-5.
constexpr double kCurveError = 1.5e-5;

Image ramp() {
  Image image(2001, 1);
  for (int x = 0; x < image.width; ++x) {
    const float v = static_cast<float>(x) / 1000 - 0.5f;
    image.at(x, 0) = {v, v * v, v / 100};
  }
  return image;
}

/// $OCIO as `value`, or unset, while this lives.
class OcioVariable {
 public:
  explicit OcioVariable(const char* value) {
    if (const char* old = std::getenv("OCIO")) old_ = old;
    value ? ::setenv("OCIO", value, 1) : ::unsetenv("OCIO");
  }
  ~OcioVariable() { old_.empty() ? ::unsetenv("OCIO") : ::setenv("OCIO", old_.c_str(), 1); }

 private:
  std::string old_;
};

class Display : public ::testing::Test {
 private:
  OcioVariable none_{nullptr};
};

TEST_F(Display, DefaultIsTheSrgbCurve) {
  const Image image = ramp();
  const Image shown = to_display(image, {});
  for (int x = 0; x < image.width; ++x) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(shown.at(x, 0)[c], srgb(image.at(x, 0)[c]), kCurveError);
    }
  }
}

TEST_F(Display, ExposureScalesLightByPowersOfTwo) {
  const Image image = ramp();
  DisplayOptions options;
  options.exposure = -1.5f;
  const Image shown = to_display(image, options);
  for (int x = 0; x < image.width; ++x) {
    EXPECT_NEAR(shown.at(x, 0).r, srgb(image.at(x, 0).r * std::exp2(-1.5)), kCurveError);
  }
}

TEST_F(Display, RawClampsAndNothingElse) {
  const Image image = ramp();
  DisplayOptions options;
  options.view = "Raw";
  const Image shown = to_display(image, options);
  for (int x = 0; x < image.width; ++x) {
    EXPECT_EQ(shown.at(x, 0).r, std::min(1.0f, std::max(0.0f, image.at(x, 0).r)));
  }
}

TEST_F(Display, AcesKeepsGreysGreyRisesAndRollsOff) {
  Image image(200, 1);
  for (int x = 0; x < 200; ++x) image.at(x, 0) = Rgb(std::exp2(static_cast<float>(x) / 10 - 10));
  DisplayOptions options;
  options.view = "ACES 1.0 SDR";
  const Image shown = to_display(image, options);
  for (int x = 1; x < 200; ++x) {
    const Rgb p = shown.at(x, 0);
    EXPECT_NEAR(p.r, p.g, 1.0 / 255) << x;  // what eight bits can tell apart
    EXPECT_NEAR(p.b, p.g, 1.0 / 255) << x;
    EXPECT_GE(p.g, shown.at(x - 1, 0).g) << x;
  }
  EXPECT_GT(shown.at(120, 0).g, shown.at(100, 0).g);  // 4 is still told from 1: no clipping there
  EXPECT_LT(shown.at(100, 0).g, 0.9f);
}

/// The RRT shows 18 % grey at 4.8 of 48 cd/m^2 (black is 0.02); the transform for video then
/// compensates the dim surround with the exponent 0.9811 (aces-dev 1.0, ODT.Academy.Rec709).
TEST_F(Display, AcesMiddleGreyIsWhereTheAcademyPutsIt) {
  Image image(1, 1);
  image.at(0, 0) = Rgb(0.18f);
  DisplayOptions options;
  options.view = "ACES 1.0 SDR";
  const double grey = std::pow((4.8 - 0.02) / (48 - 0.02), 0.9811);
  EXPECT_NEAR(to_display(image, options).at(0, 0).g, srgb(grey), 0.5 / 255);
}

TEST_F(Display, AlwaysWithinZeroAndOne) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  Image image(4, 1);
  image.pixels = {Rgb(kInf), Rgb(-kInf), Rgb(std::numeric_limits<float>::quiet_NaN()), Rgb(3e38f)};
  for (const char* view : {"Standard", "ACES 1.0 SDR", "Raw"}) {
    DisplayOptions options;
    options.view = view;
    options.exposure = 3;
    const Image shown = to_display(image, options);
    EXPECT_EQ(shown.at(2, 0), shown.at(1, 0)) << view;
    for (const Rgb& p : shown.pixels) {
      for (int c = 0; c < 3; ++c) EXPECT_TRUE(p[c] >= 0 && p[c] <= 1) << view << ' ' << p[c];
    }
    EXPECT_GT(shown.at(0, 0).g, 0.99f) << view;
  }
}

std::string message_of(const DisplayOptions& options) {
  try {
    check_display(options);
  } catch (const Error& e) {
    return e.what();
  }
  return "no Error";
}

TEST_F(Display, UnknownNamesListTheLegalOnes) {
  DisplayOptions options;
  EXPECT_EQ(message_of(options), "no Error");
  options.display = "sRBG";
  EXPECT_NE(message_of(options).find("sRGB"), std::string::npos) << message_of(options);
  options.display = "sRGB";
  options.view = "Filmic";
  for (const char* view : {"Standard", "ACES 1.0 SDR", "Raw"}) {
    EXPECT_NE(message_of(options).find(view), std::string::npos) << message_of(options);
  }
}

TEST_F(Display, MenuListsWhatTheConfigurationOffers) {
  const DisplayMenu menu = display_menu({});
  EXPECT_EQ(menu.config, "");
  EXPECT_EQ(menu.default_display, "sRGB");
  ASSERT_EQ(menu.displays.size(), 1u);
  EXPECT_EQ(menu.displays[0].views, (std::vector<std::string>{"Standard", "ACES 1.0 SDR", "Raw"}));
  EXPECT_EQ(menu.displays[0].default_view, "Standard");
  EXPECT_EQ(resolved({}).display, "sRGB");
  EXPECT_EQ(resolved({}).view, "Standard");
}

TEST_F(Display, BadConfigurationsAreNamed) {
  const test::TemporaryFolder folder;
  DisplayOptions options;
  options.ocio_config = folder / "missing.ocio";
  EXPECT_EQ(message_of(options).rfind(options.ocio_config + ": ", 0), 0u) << message_of(options);
  options.ocio_config = folder / "bad.ocio";
  std::ofstream(options.ocio_config) << "no: [such";
  EXPECT_EQ(message_of(options).rfind(options.ocio_config + ": ", 0), 0u) << message_of(options);
}

/// A configuration whose scene-linear space is ACES2065-1, reached through its role.
constexpr const char* kAcesConfig = R"(ocio_profile_version: 2
roles: {default: AP0, scene_linear: AP0, aces_interchange: AP0}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  Screen:
    - !<View> {name: Untouched, colorspace: AP0}
colorspaces:
  - !<ColorSpace> {name: AP0}
)";

TEST_F(Display, OtherConfigurationsReceiveRec709ThroughAces) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "aces.ocio") << kAcesConfig;
  const OcioVariable variable((folder / "aces.ocio").c_str());
  Image image(2, 1);
  image.pixels = {Rgb(0.5f), Rgb{0.5f, 0, 0}};
  const Image shown = to_display(image, {});
  const double float_error = 4e-7;  // three products and two sums of numbers up to 0.5
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown.at(0, 0)[c], 0.5, float_error);
  EXPECT_NEAR(shown.at(1, 0).r, 0.5 * 0.439632981919491, float_error);
  EXPECT_NEAR(shown.at(1, 0).g, 0.5 * 0.0897764429588424, float_error);
}

TEST_F(Display, AnOptionWinsOverTheEnvironment) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "aces.ocio") << kAcesConfig;
  std::ofstream(folder / "own.ocio") << shipped_display_config();
  const OcioVariable variable((folder / "aces.ocio").c_str());
  DisplayOptions options;
  options.ocio_config = folder / "own.ocio";
  options.display = "sRGB";
  EXPECT_EQ(message_of(options), "no Error");
}

}  // namespace
}  // namespace octolux
