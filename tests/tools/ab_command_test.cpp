// `octolux ab` as a user runs it: a folder of pictures, figures and a page; renders that go on
// after an interruption; and, on the thin wall, what each kernel is known for.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/image_io.h"
#include "tests/tools/browser.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;

/// A floor with a wall across it, lit on one side, seen from above.
constexpr const char* kScene = R"(<scene version="3.0.0">
  <sensor type="perspective"><float name="fov" value="50"/>
    <transform name="to_world"><lookat origin="0, 8, 0.01" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/>
      <rfilter type="box"/></film></sensor>
  <shape type="rectangle"><transform name="to_world"><scale value="3"/>
    <rotate x="1" angle="-90"/></transform></shape>
  <shape type="cube"><transform name="to_world"><scale x="0.05" y="2" z="4"/></transform></shape>
  <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/>
    <translate x="-1.5" y="1.5"/></transform>
    <emitter type="area"><rgb name="radiance" value="5"/></emitter></shape>
</scene>)";

class AbTest : public ::testing::Test {
 protected:
  AbTest() { std::ofstream(folder_ / "wall.xml") << kScene; }

  static std::vector<std::string> arguments(const std::vector<std::string>& more,
                                            const std::string& folder = "out") {
    std::vector<std::string> all = {"ab",   "wall.xml",          "-o", folder, "--photons",
                                    "2000", "--reference-error", "0.1"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome run(const std::vector<std::string>& more, const std::string& folder = "out") {
    return test::run_program(folder_, arguments(more, folder));
  }
  void expect_refused(const std::vector<std::string>& more, const std::string& part) {
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 2) << part;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  json results(const std::string& path = "out") const {
    return json::parse(test::read_file(folder_ / (path + "/ab.json")));
  }
  std::size_t kept_renders() const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/renders")) {
      count += entry.path().extension() == ".render";
    }
    return count;
  }
  std::vector<float> red(const std::string& file) const {
    return read_exr(folder_ / file).find("")->planes[0];
  }

  test::TemporaryFolder folder_;
};

using Ab = AbTest;

TEST_F(Ab, WritesAFolderThatExplainsItself) {
  const Outcome outcome =
      run({"--passes", "3", "--kernel", "cone", "feeler:published", "--gather", "off", "on"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name :
       {"cone-gather-off.exr", "cone-gather-on.png", "feeler-published-gather-off.png", "ab.png",
        "leaks.png", "index.html", "table.md", "mask-sealed.png", "mask-walls.png"}) {
    EXPECT_TRUE(fs::exists(folder_ / (std::string("out/") + name))) << name;
  }
  EXPECT_EQ(outcome.out, test::read_file(folder_ / "out/table.md"));
  EXPECT_NE(outcome.out.find("| feeler:published, gather on | 3 |"), std::string::npos);
  EXPECT_NE(outcome.err.find("[4/5] feeler, gather on, published"), std::string::npos)
      << outcome.err;
  const json all = results();
  ASSERT_EQ(all["renders"].size(), 4u);
  EXPECT_EQ(all["renders"][1]["settings"]["estimator.correction"], false);
  EXPECT_EQ(all["renders"][2]["settings"]["eye.gather"], true);
  EXPECT_EQ(all["masks"]["image"]["pixels"], 24 * 16);
  EXPECT_GT(all["masks"]["sealed"]["pixels"], 50);
  EXPECT_EQ(all["command"].get<std::string>().substr(0, 19), "octolux ab wall.xml");
  // Every number of the page is the file's.
  EXPECT_EQ(json::parse(test::data_of(test::read_file(folder_ / "out/index.html"))), all);
}

/// The whole image's leaks are those of `octolux compare`.
TEST_F(Ab, AgreesWithCompare) {
  ASSERT_EQ(run({"--passes", "3", "--kernel", "disc"}).exit_code, 0);
  std::string reference;
  for (const auto& entry : fs::directory_iterator(folder_ / "octolux-references")) {
    if (entry.path().extension() == ".exr") reference = entry.path();
  }
  const Outcome compared = test::run_program(
      folder_, {"compare", reference, "out/disc-gather-off.exr", "--json", "compare.json"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const json figures =
      json::parse(test::read_file(folder_ / "compare.json"))["images"][0]["layers"][0]["figures"];
  const json ours = results()["renders"][0]["masks"]["image"];
  for (const char* key : {"light-leak", "shadow-leak"}) {
    EXPECT_NEAR(ours[key].get<double>(), figures[key].get<double>(), 1e-12) << key;
  }
  EXPECT_EQ(ours["figures"]["relmse"], figures["relmse"]);
}

TEST_F(Ab, WhatIsThereIsNotRenderedAgain) {
  const std::vector<std::string> kernels = {"--passes", "3", "--kernel", "cone", "octobox"};
  ASSERT_EQ(run(kernels).exit_code, 0);
  const json first = results();
  const std::vector<float> three = red("out/cone-gather-off.exr");
  const Outcome again = run(kernels);
  EXPECT_NE(again.err.find("cone, gather off: 3 passes are there"), std::string::npos) << again.err;
  EXPECT_EQ(again.err.find("pass 1/3"), std::string::npos) << again.err;
  EXPECT_EQ(results()["renders"][0]["seconds"], first["renders"][0]["seconds"]);
  EXPECT_EQ(kept_renders(), 2u);

  const Outcome longer = run({"--kernel", "cone", "--passes", "5"});
  EXPECT_EQ(longer.exit_code, 0) << longer.err;
  EXPECT_NE(longer.err.find("3 passes are there"), std::string::npos) << longer.err;
  EXPECT_EQ(kept_renders(), 2u);  // five take the place of three
  ASSERT_EQ(run({"--kernel", "cone", "--passes", "5"}, "new").exit_code, 0);
  EXPECT_EQ(red("out/cone-gather-off.exr"), red("new/cone-gather-off.exr"));

  // Fewer passes are another picture, and other settings too.
  EXPECT_EQ(run({"--passes", "3", "--kernel", "cone"}).err.find("are there"), std::string::npos);
  EXPECT_EQ(red("out/cone-gather-off.exr"), three);
  EXPECT_EQ(run({"--passes", "3", "--kernel", "cone", "--seed", "2"}).err.find("are there"),
            std::string::npos);
  EXPECT_EQ(kept_renders(), 4u);
}

TEST_F(Ab, InterruptedItGoesOn) {
  const std::vector<std::string> large = {"--kernel", "cone", "--size", "96x64", "--passes", "60"};
  const test::Program program(folder_, arguments(large));
  const std::string log = folder_ / ".err";
  for (int i = 0; i < 3000 && test::read_file(log).find("pass 1/60") == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ::kill(program.process(), SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("the same command goes on from here"), std::string::npos);
  EXPECT_EQ(kept_renders(), 1u);
  EXPECT_FALSE(fs::exists(folder_ / "out/ab.json"));

  const Outcome second = run(large);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(second.err.find(" passes are there"), std::string::npos) << second.err;
  ASSERT_EQ(run(large, "new").exit_code, 0);
  EXPECT_EQ(red("out/cone-gather-off.exr"), red("new/cone-gather-off.exr"));
}

TEST_F(Ab, EqualTimeGivesEachTheSameTime) {
  const std::vector<std::string> base = {"--time", "0.3", "--kernel", "disc", "region"};
  const Outcome outcome = run(base);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json first = results();
  for (const json& render : first["renders"]) {
    const double seconds = render["seconds"], passes = render["passes"];
    EXPECT_GT(passes, 1);
    EXPECT_GT(seconds, 0.15) << render["name"];  // half of it at least: then one more pass fits
  }
  ASSERT_EQ(run(base).exit_code, 0);
  EXPECT_EQ(results()["renders"], first["renders"]);  // what is there is long enough
}

TEST_F(Ab, AGivenReferenceIsUsed) {
  const Image white(24, 16);
  write_exr(folder_ / "black.exr", {24, 16, {rgb_layer("", white)}, {}});
  const Outcome outcome = run({"--passes", "2", "--kernel", "cone", "--reference", "black.exr"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(results()["renders"][0]["masks"]["image"]["light-leak"].is_null());
  EXPECT_NE(results()["reference"].get<std::string>().find("black.exr"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "octolux-references"));
}

TEST_F(Ab, BadInputIsOneLine) {
  write_exr(folder_ / "small.exr", {8, 8, {rgb_layer("", Image(8, 8))}, {}});
  expect_refused({"--kernel", "coen"}, "did you mean 'cone'");
  expect_refused({"--kernel", "cone", "cone"}, "--kernel cone: given twice");
  expect_refused({"--gather", "of"}, "--gather: unknown gathering 'of'");
  expect_refused({"--time", "3", "--passes", "3"}, "--passes and --time: expected one of them");
  expect_refused({"--set", "estimator.kernel=cone"}, "--set estimator.kernel=cone: not here");
  expect_refused({"--reach", "0"}, "--reach 0: expected a number above 0");
  expect_refused({"--reference", "small.exr"},
                 "small.exr: is 8x8; expected the film's size, 24x16");
  expect_refused({"--reference", "none.exr"}, "none.exr: ");
  expect_refused({"--size", "7"}, "--size 7: expected WIDTHxHEIGHT");
  expect_refused({"--view", "none"}, "none");
  EXPECT_FALSE(fs::exists(folder_ / "out/ab.png"));
}

class AbPageInBrowserSlow : public AbTest {};

TEST_F(AbPageInBrowserSlow, SlidersMoveAndNumbersAreThoseOfTheJson) {
  if (!test::has_browser()) GTEST_SKIP() << test::kNoBrowser;
  ASSERT_EQ(run({"--size", "96x64", "--passes", "3"}).exit_code, 0);
  const std::string html = test::read_file(folder_ / "out/index.html");
  EXPECT_EQ(html.find("http"), std::string::npos) << "the page must not need a network";
  const json result = test::self_test(folder_, "out/index.html");
  EXPECT_TRUE(result["passed"].get<bool>()) << result;
  EXPECT_GE(result["checks"].size(), 11u);
}

class AbThinWallSlow : public AbTest {};

/// What the paper shows with pictures. Noise adds at most `noise` to the expectation of a leak, so
/// whatever exceeds it is bias; reading twice as much leaves no doubt.
TEST_F(AbThinWallSlow, ConeLeaksOctoboxMendsShadowsFeelerMendsLight) {
  const Outcome outcome = test::run_program(
      folder_, {"ab", OCTOLUX_SOURCE_DIR "/scenes/thin-wall/thin-wall.xml", "-o", "out", "--size",
                "96x54", "--photons", "10000", "--neighbours", "100", "--passes", "32", "--set",
                "photons.alpha=1", "--reference-error", "0.01"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json renders = results()["renders"];
  const auto leak = [&](int render, const char* mask, const char* key) {
    return renders[render]["masks"][mask][key].get<double>();
  };
  constexpr int kCone = 0, kOctobox = 1, kFeeler = 2;
  EXPECT_GT(leak(kCone, "sealed", "light-leak"), 2 * leak(kCone, "sealed", "noise"));
  EXPECT_GT(leak(kCone, "walls", "shadow-leak"),
            leak(kOctobox, "walls", "shadow-leak") + 2 * leak(kCone, "walls", "noise"));
  EXPECT_GT(leak(kOctobox, "sealed", "light-leak"), 2 * leak(kOctobox, "sealed", "noise"));
  EXPECT_GT(leak(kCone, "walls", "shadow-leak"),
            leak(kFeeler, "walls", "shadow-leak") + 2 * leak(kCone, "walls", "noise"));
  EXPECT_EQ(leak(kFeeler, "sealed", "light-leak"), 0);
}

}  // namespace
}  // namespace octolux
