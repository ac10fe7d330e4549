// Portals on the command line and in scene files: announced, or refused in one line with exit
// code 2.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/program.h"

namespace octolux {
namespace {

using test::Outcome;

/// A box under the sky; $shape is one more shape.
constexpr const char* kScene = R"(<scene version="3.0.0">
  <sensor type="perspective"><film type="hdrfilm">
    <integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>
  <emitter type="constant"/>
  <shape type="cube" id="block"/>
  $shape
</scene>)";

class PortalCommand : public ::testing::Test {
 protected:
  Outcome render(const std::string& shape, std::vector<std::string> more = {}) const {
    std::string text = kScene;
    text.replace(text.find("$shape"), 6, shape);
    std::ofstream(folder_ / "scene.xml") << text;
    more.insert(more.begin(), {"render", "scene.xml", "--passes", "1", "--photons", "500"});
    return test::run_program(folder_, more);
  }
  void expect_refusal(const Outcome& outcome, const std::string& fragment) const {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(fragment), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }

  test::TemporaryFolder folder_;
};

const std::string kWindow = "<shape type='rectangle' id='Portal_1'/>";

TEST_F(PortalCommand, ByNameIsAnnounced) {
  const Outcome done = render(kWindow);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE((done.out + done.err).find("'Portal_1' is a portal, not a surface"), std::string::npos);
  EXPECT_NE((done.out + done.err).find("primitives 12,"), std::string::npos) << done.err;
}

TEST_F(PortalCommand, ByOptionIsNoSurface) {
  const std::string window = "<shape type='rectangle' id='window'/>";
  const Outcome surface = render(window);
  EXPECT_NE((surface.out + surface.err).find("primitives 14,"), std::string::npos);
  const Outcome done = render(window, {"--portal", "window"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE((done.out + done.err).find("primitives 12,"), std::string::npos);
}

TEST_F(PortalCommand, Refusals) {
  expect_refusal(render("", {"--portal", "blokc"}), "--portal blokc: unknown shape 'blokc'");
  std::ofstream(folder_ / "line.ply")
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n";
  expect_refusal(render("<shape type='ply' id='portal'><string name='filename' value='line.ply'/>"
                        "</shape>"),
                 "no area");
  expect_refusal(render("<shape type='sphere' id='portal'/>"), "must consist of triangles");
  expect_refusal(render("<shape type='rectangle' id='lamp'><emitter type='area'/></shape>",
                        {"--portal", "lamp"}),
                 "the portal 'lamp' has an emitter");
}

TEST_F(PortalCommand, ALampIsNoPortalByName) {
  const Outcome done =
      render("<shape type='rectangle' id='portal_lamp'><emitter type='area'/></shape>");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ((done.out + done.err).find("is a portal"), std::string::npos);
}

}  // namespace
}  // namespace octolux
