// Defaults, defines, includes, search paths, references: how files become one document.
#include "renderer/xml_document.h"

#include <gtest/gtest.h>

#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

float radius_of_first(const Scene& scene) {
  const auto& quadric = std::get<Quadric>(scene.shapes.at(0).geometry);
  return length(quadric.to_world.vector({1, 0, 0}));
}

const std::string kSensor = "<sensor type='perspective'/>";
const std::string kSphere = "<shape type='sphere'><float name='radius' value='$r'/></shape>";

TEST(ParameterName, JoinsBothSpellings) {
  EXPECT_EQ(parameter_name("toWorld"), "to_world");
  EXPECT_EQ(parameter_name("to_world"), "to_world");
  EXPECT_EQ(parameter_name("intIOR"), "int_ior");
  EXPECT_EQ(parameter_name("fovAxis"), "fov_axis");
  EXPECT_EQ(parameter_name("alphaU"), "alpha_u");
  EXPECT_EQ(parameter_name("cropOffsetX"), "crop_offset_x");
  EXPECT_EQ(parameter_name("principalPointOffsetY"), "principal_point_offset_y");
  EXPECT_EQ(parameter_name("k"), "k");
}

TEST(Defaults, AreSubstituted) {
  const auto scene =
      load_text("<scene><default name='r' value='3'/>" + kSensor + kSphere + "</scene>");
  EXPECT_EQ(radius_of_first(*scene), 3);
}

TEST(Defaults, YieldToDefines) {
  const std::string text = "<scene><default name='r' value='3'/>" + kSensor + kSphere + "</scene>";
  EXPECT_EQ(radius_of_first(*load_text(text, {{"r", "7"}})), 7);
  const std::string no_default = "<scene>" + kSensor + kSphere + "</scene>";
  EXPECT_EQ(radius_of_first(*load_text(no_default, {{"r", "7"}})), 7);
}

TEST(Defaults, FirstOneWinsAndMayNest) {
  const auto scene = load_text(
      "<scene><default name='a' value='2'/><default name='a' value='9'/>"
      "<default name='r' value='$a.5'/>" +
      kSensor + kSphere + "</scene>");
  EXPECT_EQ(radius_of_first(*scene), 2.5f);
}

TEST(Defaults, LongestNameWins) {
  const auto scene =
      load_text("<scene><default name='r' value='1'/><default name='rad' value='4'/>" + kSensor +
                "<shape type='sphere'><float name='radius' value='$rad'/></shape></scene>");
  EXPECT_EQ(radius_of_first(*scene), 4);
}

TEST(Defaults, ReachTypesAndIds) {
  const auto scene = load_text("<scene><default name='kind' value='sphere'/>" + kSensor +
                               "<shape type='$kind'/></scene>");
  EXPECT_EQ(radius_of_first(*scene), 1);
}

TEST(Include, SplicesChildrenAndSharesDefaults) {
  const SceneFiles files;
  files.write("scene.xml",
              "<scene><default name='r' value='2'/><include filename='parts/a.xml'/>"
              "<shape type='sphere'><float name='radius' value='$s'/></shape></scene>");
  files.write("parts/a.xml", "<scene><default name='r' value='9'/><default name='s' value='5'/>" +
                                 kSensor + kSphere + "<include filename='b.xml'/></scene>");
  files.write("parts/b.xml", "<scene>" + kSphere + "</scene>");  // beside a.xml
  const auto scene = files.load();
  ASSERT_EQ(scene->shapes.size(), 3u);
  EXPECT_EQ(radius_of_first(*scene), 2);
  const auto& last = std::get<Quadric>(scene->shapes[2].geometry);
  EXPECT_EQ(last.to_world.vector({0, 1, 0}).y, 5);
}

TEST(Include, TakesASingleObjectAsRoot) {
  const SceneFiles files;
  files.write("scene.xml", "<scene>" + kSensor + "<include filename='ball.xml'/></scene>");
  files.write("ball.xml", "<shape type='sphere'/>");
  EXPECT_EQ(files.load()->shapes.size(), 1u);
}

TEST(Include, OfOneFileTwiceIsNoCycle) {
  const SceneFiles files;
  files.write("scene.xml", "<scene>" + kSensor +
                               "<include filename='a.xml'/><include filename='a.xml'/></scene>");
  files.write("a.xml", "<scene><shape type='sphere'/></scene>");
  EXPECT_EQ(files.load()->shapes.size(), 2u);
}

TEST(SearchPath, IsRelativeToItsFileAndUsedForData) {
  const SceneFiles files;
  const std::string mesh = "<shape type='obj'><string name='filename' value='tri.obj'/></shape>";
  files.write("scene.xml", "<scene><path value='common/data'/>" + kSensor + mesh +
                               "<include filename='more.xml'/></scene>");
  files.write("common/data/tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  files.write("common/data/more.xml", "<scene>" + mesh + "</scene>");
  EXPECT_EQ(files.load()->shapes.size(), 2u);
}

TEST(References, MayPointForwardAndShareObjects) {
  const auto scene = load_text("<scene>" + kSensor +
                               "<shape type='sphere'><ref id='m' name='bsdf'/></shape>"
                               "<shape type='cube'><ref id='m'/></shape>"
                               "<bsdf type='diffuse' id='m'/></scene>");
  EXPECT_EQ(scene->bsdfs.size(), 1u);
  EXPECT_EQ(scene->shapes[0].bsdf, scene->shapes[1].bsdf);
}

TEST(References, ReachNestedObjectsAndAliases) {
  const auto scene =
      load_text("<scene>" + kSensor +
                "<bsdf type='twosided' id='outer'><bsdf type='diffuse' id='inner'/></bsdf>"
                "<alias id='inner' as='other'/>"
                "<shape type='sphere'><ref id='other'/></shape></scene>");
  EXPECT_EQ(scene->bsdfs.size(), 2u);
  EXPECT_EQ(scene->shapes[0].bsdf, 0);  // the inner one is made first
}

TEST(Ignored, ElementsAreSaidOnce) {
  const auto scene = load_text("<scene><mode type='x'/>" + kSensor +
                               "<shape type='cube'><hide a='1'><b/></hide></shape>"
                               "<shape type='cube'><hide/></shape></scene>");
  EXPECT_EQ(
      std::count(scene->warnings.begin(), scene->warnings.end(), "<hide> elements are ignored"), 1);
  EXPECT_EQ(
      std::count(scene->warnings.begin(), scene->warnings.end(), "<mode> elements are ignored"), 1);
}

TEST(Hash, CoversEveryFileAndDefine) {
  const SceneFiles files;
  const auto write = [&](const std::string& radius, const std::string& vertex) {
    files.write("scene.xml",
                "<scene><default name='r' value='1'/>" + kSensor +
                    "<include filename='a.xml'/>"
                    "<shape type='obj'><string name='filename' value='t.obj'/></shape></scene>");
    files.write("a.xml", "<scene><shape type='sphere'><float name='radius' value='" + radius +
                             "'/></shape>" + kSphere + "</scene>");
    files.write("t.obj", "v 0 0 " + vertex + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  };
  write("1", "0");
  const std::uint64_t first = files.load()->hash;
  EXPECT_NE(first, 0u);
  EXPECT_EQ(files.load()->hash, first);
  EXPECT_NE(files.load({{"r", "1"}})->hash, first);
  EXPECT_NE(files.load({{"r", "1"}})->hash, files.load({{"r", "2"}})->hash);
  write("2", "0");
  EXPECT_NE(files.load()->hash, first);
  write("1", "1");
  EXPECT_NE(files.load()->hash, first);
  write("1", "0");
  EXPECT_EQ(files.load()->hash, first);
}

}  // namespace
}  // namespace octolux::test
