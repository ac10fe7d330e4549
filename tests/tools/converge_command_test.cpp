// `octolux converge` as a user runs it: what it writes, that it goes on where it stopped, and what
// it refuses.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/image_io.h"
#include "tests/tools/pictures.h"
#include "tests/tools/program.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;
using test::Outcome;

class ConvergeCommand : public ::testing::Test {
 protected:
  /// A race of a second over very small pictures.
  std::vector<std::string> race(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"converge",
                                      OCTOLUX_SOURCE_DIR "/scenes/cornell/cornell.xml",
                                      "--size",
                                      "8x8",
                                      "--photons",
                                      "500",
                                      "--set",
                                      "photons.caustic=0",
                                      "--kernel",
                                      "octobox",
                                      "--seeds",
                                      "3",
                                      "--passes",
                                      "8",
                                      "--time",
                                      "60",
                                      "--reference-error",
                                      "0.2",
                                      "-o",
                                      "out"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Outcome run(const std::vector<std::string>& words) const { return run_program(folder_, words); }
  nlohmann::json json() const {
    return nlohmann::json::parse(test::read_file(folder_ / "out/converge.json"));
  }
  /// All pictures of all runs, by their path, as bytes of their pixels.
  std::map<std::string, std::vector<std::vector<float>>> pictures(const std::string& folder) const {
    std::map<std::string, std::vector<std::vector<float>>> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      if (entry.path().extension() != ".exr") continue;
      const std::string name = fs::relative(entry.path(), folder_ / folder).string();
      all[name] = read_exr(entry.path().string()).layers.front().planes;
    }
    return all;
  }

  test::TemporaryFolder folder_;
};

TEST_F(ConvergeCommand, WritesEverything) {
  const Outcome outcome = run(race());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("fastest to 10 % error"), std::string::npos) << outcome.out;
  for (const char* file : {"index.html", "pictures.html", "converge.csv", "converge.svg"}) {
    EXPECT_GT(fs::file_size(folder_ / ("out/" + std::string(file))), 500u) << file;
  }
  const Image plot = read_image(folder_ / "out/converge.png", Encoding::automatic);
  EXPECT_EQ(plot.width, 1800);
  const nlohmann::json result = json();
  ASSERT_EQ(result["series"].size(), 2u);
  for (const auto& series : result["series"]) {
    ASSERT_EQ(series["points"].size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(series["points"][i]["passes"], 1 << i);
      EXPECT_EQ(series["points"][i]["seeds"].size(), 3u);
    }
  }
  EXPECT_EQ(pictures("out").size(), 2u * 3 * 4);
}

TEST_F(ConvergeCommand, ASecondRunRendersNothing) {
  ASSERT_EQ(run(race()).exit_code, 0);
  const nlohmann::json first = json();
  const Outcome outcome = run(race());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err.find("pass 1"), std::string::npos) << outcome.err;
  EXPECT_EQ(json()["series"], first["series"]);  // times included
}

TEST_F(ConvergeCommand, GoesFurtherFromWhatIsThere) {
  ASSERT_EQ(run(race({"--passes", "2"})).exit_code, 2);  // given twice
  std::vector<std::string> words = race();
  *(std::find(words.begin(), words.end(), "--passes") + 1) = "2";
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(pictures("out").size(), 2u * 3 * 2);
  ASSERT_EQ(run(race()).exit_code, 0);
  const auto grown = pictures("out");
  fs::remove_all(folder_ / "out");
  ASSERT_EQ(run(race()).exit_code, 0);
  EXPECT_EQ(pictures("out"), grown);
}

/// Stopped by Ctrl-C somewhere, and run again: the same pictures as without a break.
TEST_F(ConvergeCommand, GoesOnAfterCtrlC) {
  ASSERT_EQ(run(race()).exit_code, 0);
  const auto whole = pictures("out");
  fs::remove_all(folder_ / "out");
  const test::Program program(folder_, race());
  for (int i = 0; i < 5000 && !fs::exists(folder_ / "out/runs"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  for (int i = 0; i < 5000 && fs::is_empty(folder_ / "out/runs"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(program.process(), SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_LT(pictures("out").size(), whole.size());
  const Outcome rest = run(race());
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_EQ(pictures("out"), whole);
}

TEST_F(ConvergeCommand, OthersPicturesJoin) {
  const Image grey = test::constant(8, 8, Rgb(0.3f));
  write_exr(folder_ / "a.exr", test::picture("a", grey).file);
  const Outcome outcome = run(race({"--add", "another=1.5:a.exr,3:a.exr"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json series = json()["series"][2];
  EXPECT_EQ(series["name"], "another");
  EXPECT_EQ(series["external"], true);
  EXPECT_EQ(series["points"][1]["seconds"], 3);
}

TEST_F(ConvergeCommand, AGivenReferenceIsAveragedDown) {
  write_exr(folder_ / "truth.exr", test::picture("", test::constant(16, 16, Rgb(0.3f))).file);
  const Outcome outcome = run(race({"--reference", "truth.exr"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json()["reference"], "truth.exr, averaged down by 2");
}

TEST_F(ConvergeCommand, RefusesWhatCannotBe) {
  write_exr(folder_ / "odd.exr", test::picture("", test::constant(12, 12, Rgb(1))).file);
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{"--reference", "odd.exr"}, "odd.exr: is 12x12; expected the film's size, 8x8"},
      {{"--reference", "none.exr"}, "none.exr"},
      {{"--add", "x=1:odd.exr"}, "odd.exr: is 12x12; expected 8x8"},
      {{"--add", "x=soon:a.exr"}, "no time above 0 in 'soon:a.exr'"},
      {{"--clock", "sun"}, "unknown clock 'sun'; legal: cpu, wall"},
      {{"--integrator", "bdpt"}, "unknown integrator 'bdpt'"},
      {{"--gather", "maybe"}, "--gather maybe: expected on or off"},
      {{"--reference-time", "0"}, "--reference-time 0: expected a number above 0"},
      {{"--set", "seed=3"}, "--set seed=3: not here"},
  };
  for (const auto& [words, message] : cases) {
    const Outcome outcome = run(race(words));
    EXPECT_EQ(outcome.exit_code, 2) << words.front();
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
}

/// The page in a browser, where there is one: it loads, and its tables hold the JSON's numbers.
TEST_F(ConvergeCommand, ThePageLoads) {
  if (std::system("command -v chromium >/dev/null") != 0) {
    GTEST_SKIP() << "no chromium here to open the page with";
  }
  ASSERT_EQ(run(race()).exit_code, 0);
  const std::string command =
      "chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr --dump-dom file://" +
      folder_.path() + "/out/index.html >" + folder_.path() + "/dom 2>" + folder_.path() + "/log";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string dom = test::read_file(folder_ / "dom");
  EXPECT_EQ(test::read_file(folder_ / "log").find("CONSOLE"), std::string::npos);
  EXPECT_NE(dom.find("<svg"), std::string::npos);
  EXPECT_NE(dom.find("id=\"targets\""), std::string::npos);
  char shown[32];
  const double rel_mse = json()["series"][0]["points"][0]["relmse"];
  std::snprintf(shown, sizeof shown, "<td>%.3e</td>", rel_mse);
  EXPECT_NE(dom.find(shown), std::string::npos) << shown;
}

}  // namespace
}  // namespace octolux
