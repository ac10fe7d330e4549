// `octolux compare` as a user runs it: files in, table, JSON, gates and complaints out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/tools/pictures.h"
#include "tests/tools/program.h"
#include "tools/compare/colour_map.h"

namespace octolux {
namespace {

using test::constant;
using test::Outcome;
using test::run_program;

class Compare : public ::testing::Test {
 protected:
  /// Writes `image` as an EXR with a layer albedo.
  void write(const std::string& name, const Image& image) {
    NamedPicture picture = test::picture(name, image);
    picture.file.layers.push_back(rgb_layer("albedo", constant(image.width, image.height, Rgb(1))));
    write_exr(folder_ / name, picture.file);
  }
  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return run_program(folder_, arguments);
  }
  /// The run must fail with exit code 2 and one line that holds `part`.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& part) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << part;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }

  test::TemporaryFolder folder_;
};

TEST_F(Compare, PrintsFiguresWithTheirFormulasAndWritesJson) {
  write("y.exr", constant(16, 8, Rgb(0.5f)));
  write("a.exr", constant(16, 8, Rgb(0.75f)));
  write("b.exr", constant(16, 8, Rgb(0.5f)));
  const Outcome outcome = run({"y.exr", "a.exr", "b.exr", "--json", "out.json", "--flip"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"mean (x-y)^2/(y^2+0.01)", "0.24038", "HDR-FLIP", "light leak"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << outcome.out;
  }
  const auto json = nlohmann::json::parse(test::read_file(folder_ / "out.json"));
  const auto& a = json["images"][0]["layers"][0]["figures"];
  EXPECT_NEAR(a["relmse"].get<double>(), 0.0625 / 0.26, 384 * 2.3e-16);  // of 384 values
  EXPECT_EQ(a["light-leak"].get<double>(), 0.5);
  EXPECT_GT(a["flip"].get<double>(), 0);
  EXPECT_EQ(json["images"][1]["layers"][0]["figures"]["relmse"], 0);
  EXPECT_TRUE(json["images"][1]["layers"][0]["figures"]["psnr"].is_null());  // infinite
  EXPECT_EQ(json["formulas"]["rmse"], "sqrt(MSE)");
}

TEST_F(Compare, GatesDecideTheExitCodeWithOneLineEach) {
  write("y.exr", constant(16, 8, Rgb(0.5f)));
  write("x.exr", constant(16, 8, Rgb(0.75f)));
  EXPECT_EQ(run({"y.exr", "x.exr", "--max-relmse", "0.25", "--min-psnr", "12"}).exit_code, 0);
  const Outcome outcome = run({"y.exr", "x.exr", "--max-relmse", "0.24", "--max-mae", "0.25"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("x.exr: relMSE 0.240385, at most 0.24 wanted: FAILED\n"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("x.exr: MAE 0.25, at most 0.25 wanted\n"), std::string::npos);
  EXPECT_EQ(run({"y.exr", "x.exr", "--max-flip", "0.001"}).exit_code, 1);
}

TEST_F(Compare, ValuesThatAreNotFiniteAreSaidAndFailGates) {
  Image image = constant(16, 8, Rgb(0.5f));
  write("y.exr", image);
  image.at(5, 3).g = std::numeric_limits<float>::quiet_NaN();
  write("x.exr", image);
  const Outcome outcome = run({"y.exr", "x.exr"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("x.exr: 1 pixels NaN and 0 infinite, the first at 5,3; left out"),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(run({"y.exr", "x.exr", "--max-relmse", "1"}).exit_code, 1);
}

TEST_F(Compare, NoiseIsAGateWhereItIsKnown) {
  const Image grey = constant(8, 8, Rgb(1)), variance = constant(8, 8, Rgb(0.01f));
  write_exr(folder_ / "y.exr", test::noisy_picture("", grey, variance, 64).file);
  write_exr(folder_ / "near.exr", test::picture("", constant(8, 8, Rgb(1.2f))).file);
  write_exr(folder_ / "far.exr", test::picture("", constant(8, 8, Rgb(2.2f))).file);
  const Outcome near = run({"y.exr", "near.exr", "--within-noise"});
  EXPECT_EQ(near.exit_code, 0) << near.out << near.err;
  EXPECT_NE(near.out.find("bias^2"), std::string::npos);
  EXPECT_EQ(run({"y.exr", "far.exr", "--within-noise"}).exit_code, 1);
  expect_refused({"near.exr", "far.exr", "--within-noise"}, "needs a layer 'variance'");
}

TEST_F(Compare, LayersAndMasksChooseWhatIsMeasured) {
  write("y.exr", constant(16, 8, Rgb(0.5f)));
  write("x.exr", test::paint(16, 8, [](int x, int) { return Rgb(x < 8 ? 0.5f : 1.5f); }));
  write("left.exr", test::paint(16, 8, [](int x, int) { return Rgb(x < 8 ? 1.f : 0.f); }));
  EXPECT_EQ(run({"y.exr", "x.exr", "--max-mse", "0"}).exit_code, 1);
  EXPECT_EQ(run({"y.exr", "x.exr", "--max-mse", "0", "--layer", "albedo"}).exit_code, 0);
  EXPECT_EQ(run({"y.exr", "x.exr", "--max-mse", "0", "--mask", "left.exr"}).exit_code, 0);
  EXPECT_EQ(run({"y.exr", "x.exr", "--max-mse", "0", "--rect", "0,0,8x8"}).exit_code, 0);
  EXPECT_EQ(run({"y.exr", "x.exr", "--max-mse", "0", "--rect", "0,0,9x8"}).exit_code, 1);
  const Outcome all = run({"y.exr", "x.exr", "--layer", "all"});
  EXPECT_NE(all.out.find("layer 'albedo'"), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("the root layer"), std::string::npos) << all.out;
}

TEST_F(Compare, WritesPicturesInTheWantedRange) {
  write("y.exr", constant(40, 30, Rgb(0.5f)));
  write("x.exr", constant(40, 30, Rgb(0.6f)));
  const Outcome outcome =
      run({"y.exr", "x.exr", "--side-by-side", "s.png", "--heat-map", "h.png", "--range", "0.1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Image heat = read_image(folder_ / "h.png", Encoding::linear);
  const Rgb end = ColourMap::diverging()(1);  // 0.1 / sqrt(0.26) is beyond 0.1
  const auto pixels = std::count_if(heat.pixels.begin(), heat.pixels.end(), [&](Rgb p) {
    return std::abs(p.r - end.r) + std::abs(p.g - end.g) + std::abs(p.b - end.b) < 1.5f / 255;
  });
  EXPECT_GE(pixels, 8 * 8 * 40 * 30);
  EXPECT_GT(read_image(folder_ / "s.png", Encoding::linear).width, 640);
  expect_refused({"y.exr", "x.exr", "--heat-map", "h.png", "--range", "0"}, "--range 0");
  expect_refused({"y.exr", "x.exr", "--heat-map", "no/h.png"}, "no/h.png: ");
}

TEST_F(Compare, InfoListsDisplays) {
  const Outcome outcome = run_program(folder_, {"info", "--ocio"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("display    sRGB (default)\n  view     Standard (default)\n"),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(run_program(folder_, {"info", "--ocio", "none.ocio"}).exit_code, 2);
  EXPECT_EQ(run_program(folder_, {"info"}).exit_code, 2);
}

TEST_F(Compare, BadInputIsOneLine) {
  write("y.exr", constant(16, 8, Rgb(0.5f)));
  write("small.exr", constant(8, 8, Rgb(0.5f)));
  NamedPicture depth = test::picture("", constant(16, 8, Rgb(0.5f)));
  depth.file.layers = {{"depth", {"Z"}, {std::vector<float>(128, 1)}}};
  write_exr(folder_ / "depth.exr", depth.file);
  expect_refused({"y.exr", "small.exr"}, "small.exr: has 8x8 pixels; expected 16x8");
  expect_refused({"y.exr", "none.exr"}, "none.exr: ");
  expect_refused({"y.exr", "depth.exr"}, "depth.exr: has no channels in the root layer");
  expect_refused({"y.exr", "y.exr", "--layer", "albdo"},
                 "y.exr: has no channels in layer 'albdo'; there are: the root layer, layer "
                 "'albedo'");
  expect_refused({"y.exr", "depth.exr", "--layer", "all"}, "no layer in common");
  expect_refused({"y.exr", "y.exr", "--max-relmse", "tiny"},
                 "--max-relmse tiny: expected a number");
  expect_refused({"y.exr", "y.exr", "--rect", "0,0,17x8"}, "does not lie inside");
  expect_refused({"y.exr", "y.exr", "--json", "no/where.json"}, "no/where.json: ");
  expect_refused({"y.exr", "y.exr", "--view", "Filmic"}, "Filmic");
  expect_refused({"y.exr", "y.exr", "--max-bias2", "1"}, "needs a layer 'variance'");
}

}  // namespace
}  // namespace octolux
