// build/bench_scaling as a user runs it: what it writes, and what it refuses. Left out where the
// benchmark programs are not built.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/image_io.h"
#include "tests/tools/program.h"

namespace octolux {
namespace {

class ScalingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kProgram)) GTEST_SKIP() << "there is no " << kProgram;
  }
  test::Outcome run(const std::vector<std::string>& arguments) const {
    return test::run_program(folder_, arguments, kProgram);
  }
  std::string written(const std::string& name) const { return test::read_file(folder_ / name); }

  static constexpr char kProgram[] = OCTOLUX_BINARY_DIR "/bench_scaling";
  test::TemporaryFolder folder_;
};

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_F(ScalingTest, WritesTableAndPlot) {
  const test::Outcome outcome = run({"--only", "pixels", "--largest", "1e4", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("pass [s]"), std::string::npos) << outcome.out;
  const std::string csv = written("out/scaling.csv");
  EXPECT_EQ(count_lines(csv), 3u) << csv;  // header, 64 x 64 and 96 x 96 pixels
  EXPECT_NE(csv.find("\npixels,4096,pixels,pass,s,"), std::string::npos) << csv;
  EXPECT_NE(written("out/scaling.svg").find("Pixels: Cornell"), std::string::npos);
  EXPECT_GT(read_image(folder_ / "out/scaling.png", Encoding::linear).width, 100);
}

TEST_F(ScalingTest, SaysWhatMemoryTheLargestStepNeeds) {
  const test::Outcome outcome = run({"--only", "photons", "--largest", "4e4", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("GB of memory"), std::string::npos) << outcome.out;
  const std::string csv = written("out/scaling.csv");
  EXPECT_EQ(count_lines(csv), 7u) << csv;  // two steps of trace, build map and memory
}

TEST_F(ScalingTest, RefusesWhatItDoesNotKnowInOneLine) {
  const std::vector<std::vector<std::string>> bad = {{"--only", "photon"},  {"--largest", "many"},
                                                     {"--largest", "-1"},   {"--largest", "0.5"},
                                                     {"--smallest", "1e3"}, {"stray"},
                                                     {"-o", "/dev/null"}};
  for (const auto& arguments : bad) {
    const test::Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments.back();
    EXPECT_EQ(count_lines(outcome.err), 1u) << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments.back();
  }
}

}  // namespace
}  // namespace octolux
