// The page of compared pictures: its formats, and the page itself in a browser, where there is one.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>

#include "core/file_io.h"
#include "tests/tools/browser.h"
#include "tests/tools/pictures.h"
#include "tools/compare/page.h"

namespace octolux {
namespace {

using test::constant;
using test::data_of;
using test::run_program;
using test::TemporaryFolder;

TEST(Page, Base64IsThatOfTheStandard) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xfb\xff"), "+/8=");
}

/// Every row starts anew, values are halves, low bytes come first.
TEST(Page, PlanesAreDifferencesOfHalfFloats) {
  // 1 is 0x3c00, 2 is 0x4000, -1 is 0xbc00, 1e6 is infinite: 0x7c00.
  const std::string packed = encode_planes({{1, 2, -1, 1e6f}}, 2);
  const unsigned char expected[] = {0x00, 0x00, 0x00, 0x00, 0x3c, 0x04, 0xbc, 0xc0};
  std::string bytes(compressBound(8), '\0');
  uLongf size = bytes.size();
  compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, expected, 8, Z_DEFAULT_COMPRESSION);
  EXPECT_EQ(packed, base64(bytes.substr(0, size)));
}

TEST(Page, ViewsAreCurvesUnlessChannelsMix) {
  const auto standard = view_table({});
  EXPECT_EQ(standard["kind"], "curve");
  EXPECT_EQ(standard["error"], 2);
  EXPECT_EQ(standard["table"].get<std::string>().size(), 4096u * 4);
  DisplayOptions aces;
  aces.view = "ACES 1.0 SDR";
  const auto cube = view_table(aces);
  EXPECT_EQ(cube["kind"], "cube");
  EXPECT_EQ(cube["error"], 2);
  EXPECT_EQ(cube["table"].get<std::string>().size(), 49u * 49 * 49 * 4);
}

TEST(Page, TextCannotEndAScript) {
  Page page;
  page.title = "</script><script>alert(1)</script>";
  page.pictures.push_back({"<b>", constant(3, 2, Rgb(1))});
  page.data = R"({"name": "</script>"})";
  const std::string html = make_page(page);
  EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(data_of(html))["name"], "</script>");
}

TEST(Page, LargePicturesAreShrunkAndItSaysSo) {
  Page page;
  page.pictures.push_back({"large", constant(2000, 1500, Rgb(0.5f))});
  page.data = "{}";
  const std::string html = make_page(page);
  EXPECT_NE(html.find("2000x1500 pixels, shown at 1/2"), std::string::npos);
  EXPECT_NE(html.find("\"width\":1000"), std::string::npos);
}

/// Runs the built program on pictures with all that is hard: fireflies, NaN, black, highlights.
class PageInBrowserSlow : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_browser()) GTEST_SKIP() << test::kNoBrowser;
    write_exr(folder_ / "y.exr", test::picture("", picture(1)).file);
    write_exr(folder_ / "bright.exr", test::picture("", picture(1.3f)).file);
    Image broken = picture(0.9f);
    broken.at(3, 2) = Rgb(std::numeric_limits<float>::quiet_NaN());
    broken.at(9, 2) = Rgb(1e30f);
    write_exr(folder_ / "broken.exr", test::picture("", broken).file);
  }

  static Image picture(float scale) {
    return test::paint(60, 40, [&](int x, int y) {
      const float v = scale * std::exp2(static_cast<float>(x) / 6 - 6);
      return Rgb{v, v * static_cast<float>(y) / 40, y < 20 ? 0.2f : 2 * v};
    });
  }

  std::string make(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"compare", "y.exr",  "bright.exr", "broken.exr", "--html",
                                          "p.html",  "--json", "p.json",     "--flip"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::Outcome outcome = run_program(folder_, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return test::read_file(folder_ / "p.html");
  }

  nlohmann::json test_page() { return test::self_test(folder_, "p.html"); }

  TemporaryFolder folder_;
};

TEST_F(PageInBrowserSlow, SlidersMoveAndNumbersAreThoseOfTheJson) {
  const std::string html = make({});
  EXPECT_EQ(nlohmann::json::parse(data_of(html)),
            nlohmann::json::parse(test::read_file(folder_ / "p.json")));
  EXPECT_EQ(html.find("http"), std::string::npos) << "the page must not need a network";
  const nlohmann::json result = test_page();
  EXPECT_TRUE(result["passed"].get<bool>()) << result;
  EXPECT_GE(result["checks"].size(), 11u);
}

TEST_F(PageInBrowserSlow, OtherViewsAndExposuresLookAsOpenColorIoShowsThem) {
  make({"--view", "ACES 1.0 SDR", "--exposure", "-1.5"});
  const nlohmann::json result = test_page();
  EXPECT_TRUE(result["passed"].get<bool>()) << result;
}

/// A wrong number in the page does not pass unseen.
TEST_F(PageInBrowserSlow, TheSelfTestCanFail) {
  std::string html = make({});
  const std::string mark = "\"exposure\":0";
  const auto at = html.find(mark);
  ASSERT_NE(at, std::string::npos);
  html.replace(at, mark.size(), "\"exposure\":1");
  write_file(folder_ / "p.html", html);
  const nlohmann::json result = test_page();
  EXPECT_FALSE(result["passed"].get<bool>()) << result;
  EXPECT_FALSE(result["checks"]["colours"].get<bool>()) << result;
}

}  // namespace
}  // namespace octolux
