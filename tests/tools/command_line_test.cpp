// The command line as a user meets it: help, refusals with one line and exit code 2, and renders of
// a tiny room.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "core/image_io.h"
#include "tests/tools/program.h"

namespace octolux {
namespace {

using test::Outcome;
using test::Program;
using test::TemporaryFolder;

/// A floor under a lamp: everything a render needs, at 24 by 16 pixels.
constexpr const char* kScene = R"(<scene version="2.1.0">
  <default name="radiance" value="10"/>
  <sensor type="perspective">
    <float name="fov" value="45"/>
    <transform name="toWorld"><lookat origin="0, 1, 4" target="0, 1, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm">
      <integer name="width" value="24"/><integer name="height" value="16"/>
      <rfilter type="box"/>
    </film>
  </sensor>
  <shape type="cube">
    <transform name="toWorld"><translate x="0" y="1" z="0"/></transform>
    <bsdf type="twosided"><bsdf type="diffuse"/></bsdf>
  </shape>
  <shape type="rectangle">
    <transform name="toWorld">
      <rotate x="1" angle="-90"/><scale value="5"/>
    </transform>
    <bsdf type="diffuse"/>
  </shape>
  <shape type="rectangle">
    <transform name="toWorld"><rotate x="1" angle="90"/><translate y="3"/></transform>
    <emitter type="area"><rgb name="radiance" value="$radiance"/></emitter>
  </shape>
</scene>)";

class CommandLine : public ::testing::Test {
 protected:
  CommandLine() { std::ofstream(folder_ / "room.xml") << kScene; }

  Outcome run(const std::vector<std::string>& arguments) const {
    return test::run_program(folder_, arguments);
  }
  /// `render room.xml`, tiny and quick, with more arguments.
  Outcome render(std::vector<std::string> more) const {
    const std::vector<std::string> quick = {"render",    "room.xml", "--passes",          "2",
                                            "--photons", "500",      "--caustic-photons", "0"};
    more.insert(more.begin(), quick.begin(), quick.end());
    return run(more);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  TemporaryFolder folder_;
};

TEST_F(CommandLine, HelpAndVersionGoToStdout) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"--version"},
                                                    {"render", "--help"},
                                                    {"ab", "--help"},
                                                    {"info", "--help"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find("octolux"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(CommandLine, HelpNamesEveryOptionAndSetting) {
  const std::string help = run({"render", "--help"}).out;
  for (const char* word : {"--integrator",
                           "--kernel",
                           "--gather",
                           "--passes",
                           "--time",
                           "--error",
                           "--spp",
                           "--photons",
                           "--caustic-photons",
                           "--neighbours",
                           "--size",
                           "--threads",
                           "--seed",
                           "-D",
                           "--set",
                           "--quiet",
                           "--display",
                           "--view",
                           "--exposure",
                           "--ocio",
                           "--no-png",
                           "-o",
                           "estimator.kernel",
                           "eye.gather_rays",
                           "photons.alpha"}) {
    EXPECT_NE(help.find(word), std::string::npos) << word;
  }
}

struct Refusal {
  std::vector<std::string> arguments;
  const char* part;  // of the message
};

/// What is wrong with a command line is said in one line, before any work.
TEST_F(CommandLine, BadArgumentsAreRefused) {
  const Refusal refusals[] = {
      {{}, "no command"},
      {{"rendr", "room.xml"}, "did you mean 'render'"},
      {{"render"}, "SCENE"},
      {{"--passes", "3"}, "no command"},
      {{"render", "room.xml", "other.xml"}, "'other.xml'"},
      {{"render", "room.xml", "--kernal", "disc"}, "did you mean '--kernel'"},
      {{"render", "room.xml", "--kernel", "dsic"}, "did you mean 'disc'"},
      {{"render", "room.xml", "--integrator", "pth"}, "did you mean 'path'"},
      {{"render", "room.xml", "--gather", "maybe"}, "on or off"},
      {{"render", "room.xml", "--passes", "-3"}, "above 0"},
      {{"render", "room.xml", "--passes", "0"}, "above 0"},
      {{"render", "room.xml", "--passes", "1.5"}, "whole number"},
      {{"render", "room.xml", "--spp", "-1"}, "above 0"},
      {{"render", "room.xml", "--time", "nan"}, "a number"},
      {{"render", "room.xml", "--error", "1%"}, "a number"},
      {{"render", "room.xml", "--quiet", "--photons", "1000000000000"}, "photons; expected at"},
      {{"render", "room.xml", "--photons", "-5"}, "photons.global"},
      {{"render", "room.xml", "--neighbours", "0"}, "neighbours"},
      {{"render", "room.xml", "--seed", "-1"}, "whole number"},
      {{"render", "room.xml", "--threads", "-1"}, "whole number"},
      {{"render", "room.xml", "--size", "640"}, "640x480"},
      {{"render", "room.xml", "--size", "0x4"}, "from 1"},
      {{"render", "room.xml", "--size", "4x"}, "whole number"},
      {{"render", "room.xml", "--size", "65536x65536"}, "2^28"},
      {{"render", "room.xml", "--set", "eye.gther=on"}, "did you mean 'eye.gather'"},
      {{"render", "room.xml", "--set", "seed"}, "key=value"},
      {{"render", "room.xml", "-D", "=3"}, "name=value"},
      {{"render", "room.xml", "-o", "room.jpg"}, ".exr"},
      {{"render", "room.xml", "-o", "missing/room.exr"}, "no folder 'missing'"},
      {{"render", "room.xml", "--display", "sRBG"}, "did you mean 'sRGB'"},
      {{"render", "room.xml", "--view", "Standrd"}, "did you mean 'Standard'"},
      {{"render", "room.xml", "--exposure", "bright"}, "a number"},
      {{"render", "room.xml", "--ocio", "missing.ocio"}, "missing.ocio: "},
      {{"render", "missing.xml"}, "missing.xml"},
      {{"info", "missing.obj"}, "missing.obj"},
  };
  for (const Refusal& refusal : refusals) {
    const Outcome outcome = run(refusal.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << refusal.part;
    EXPECT_EQ(outcome.out, "") << refusal.part;
    EXPECT_EQ(outcome.err.rfind("octolux: ", 0), 0u) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(refusal.part), std::string::npos) << outcome.err;
  }
  EXPECT_FALSE(exists("room.exr"));
}

TEST_F(CommandLine, RendersToTheScenesNameInTheCurrentFolder) {
  const Outcome outcome = render({});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("room.exr"), std::string::npos) << outcome.err;
  EXPECT_TRUE(exists("room.png"));
  const ExrFile file = read_exr(folder_ / "room.exr");
  EXPECT_EQ(file.width, 24);
  EXPECT_EQ(file.height, 16);
  EXPECT_NE(file.attributes.text.at("octolux.command").find("--photons 500"), std::string::npos);
}

TEST_F(CommandLine, QuietSaysNothing) {
  const Outcome outcome = render({"--quiet", "--no-png"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_FALSE(exists("room.png"));
}

/// Root layer of the picture that `render` with these arguments writes.
std::vector<Rgb> pixels(const TemporaryFolder& folder) {
  return read_exr(folder / "room.exr").image().pixels;
}

TEST_F(CommandLine, ThreadsAndDisplayLeaveTheLightAlone) {
  ASSERT_EQ(render({"--threads", "1"}).exit_code, 0);
  const std::vector<Rgb> light = pixels(folder_);
  const std::string png = test::read_file(folder_ / "room.png");
  ASSERT_EQ(render({"--threads", "3", "--exposure", "2", "--view", "ACES 1.0 SDR"}).exit_code, 0);
  EXPECT_EQ(pixels(folder_), light);
  EXPECT_NE(test::read_file(folder_ / "room.png"), png);
  ASSERT_EQ(render({"--seed", "2"}).exit_code, 0);
  EXPECT_NE(pixels(folder_), light);
}

TEST_F(CommandLine, OptionsAreShortForSettings) {
  ASSERT_EQ(render({"--kernel", "disc"}).exit_code, 0);
  const std::vector<Rgb> disc = pixels(folder_);
  ASSERT_EQ(render({"--set", "estimator.kernel=disc"}).exit_code, 0);
  EXPECT_EQ(pixels(folder_), disc);
  ASSERT_EQ(render({"--set", "estimator.kernel=cone"}).exit_code, 0);
  EXPECT_NE(pixels(folder_), disc);
}

TEST_F(CommandLine, SizeReplacesTheFilms) {
  ASSERT_EQ(render({"--size", "10x6", "--integrator", "path"}).exit_code, 0);
  const ExrFile file = read_exr(folder_ / "room.exr");
  EXPECT_EQ(file.width, 10);
  EXPECT_EQ(file.height, 6);
}

TEST_F(CommandLine, DefinesReachTheScene) {
  ASSERT_EQ(render({"-D", "radiance=0"}).exit_code, 0);
  for (const Rgb& pixel : pixels(folder_)) EXPECT_TRUE(is_black(pixel));
}

TEST_F(CommandLine, SplitLayersAddUpToThePicture) {
  ASSERT_EQ(render({"--split"}).exit_code, 0);
  const ExrFile file = read_exr(folder_ / "room.exr");
  const Image sum = file.image(), direct = file.image("direct"), caustic = file.image("caustic"),
              indirect = file.image("indirect");
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
    const Rgb parts = direct.pixels[i] + caustic.pixels[i] + indirect.pixels[i];
    // Four roundings of sums of positive numbers, in another order.
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(parts[c], sum.pixels[i][c], 4 * 0x1p-23 * sum.pixels[i][c]);
    }
  }
}

/// Waits until the program has said `word` on stderr, a minute at most. Did it?
bool has_said(const TemporaryFolder& folder, const std::string& word) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end) {
    if (test::read_file(folder / ".err").find(word) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

/// Told to stop after its first pass, a render that has ten minutes ends at once, with a whole
/// picture.
void expect_stop_by(int signal, const TemporaryFolder& folder) {
  const Program program(folder, {"render", "room.xml", "--photons", "500", "--time", "600"});
  EXPECT_TRUE(has_said(folder, "pass 1"));
  ::kill(program.process(), signal);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("finishing this pass"), std::string::npos) << outcome.err;
  EXPECT_EQ(read_exr(folder / "room.exr").width, 24);
  EXPECT_TRUE(std::filesystem::exists(folder / "room.png"));
}

TEST_F(CommandLine, CtrlCFinishesThePassAndWrites) { expect_stop_by(SIGINT, folder_); }

TEST_F(CommandLine, KillFinishesThePassAndWrites) { expect_stop_by(SIGTERM, folder_); }

TEST_F(CommandLine, InfoTellsWhatWasLoaded) {
  const Outcome outcome = run({"info", "room.xml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"triangles", "24x16", "box filter", "emitters", "materials", "bounds"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
  }
  // A square of side 2 and radiance 10: power = area * pi * radiance.
  EXPECT_NE(outcome.out.find("125.664"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace octolux
