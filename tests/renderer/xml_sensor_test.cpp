// Camera, film and integrator of scene files.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/constants.h"
#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

float fov_x(const std::string& parameters, int width = 200, int height = 100) {
  const auto scene =
      load_text("<scene><sensor type='perspective'>" + parameters +
                "<film type='hdrfilm'><integer name='width' value='" + std::to_string(width) +
                "'/><integer name='height' value='" + std::to_string(height) +
                "'/></film></sensor><shape type='cube'/></scene>");
  return scene->camera_config.fov_x_degrees;
}

std::string fov(const std::string& axis) {
  return "<float name='fov' value='90'/><string name='fov_axis' value='" + axis + "'/>";
}

TEST(XmlSensor, FieldOfViewAlongEveryAxis) {
  // tan 45 degrees = 1, and a film of 2 x 1: the other axis has tangent 2 or 1/2.
  const float wide = 2 * std::atan(2.0f) * 180 / kPi;
  EXPECT_FLOAT_EQ(fov_x("<float name='fov' value='90'/>"), 90);
  EXPECT_FLOAT_EQ(fov_x(fov("x")), 90);
  EXPECT_FLOAT_EQ(fov_x(fov("y")), wide);
  EXPECT_FLOAT_EQ(fov_x(fov("smaller")), wide);
  EXPECT_FLOAT_EQ(fov_x(fov("larger")), 90);
  EXPECT_FLOAT_EQ(fov_x(fov("smaller"), 100, 200), 90);
  EXPECT_FLOAT_EQ(fov_x(fov("larger"), 100, 200), 2 * std::atan(0.5f) * 180 / kPi);
  EXPECT_FLOAT_EQ(fov_x(fov("smaller"), 100, 100), 90);
  // Half the diagonal is 1 at distance 1; its x part is 2 / sqrt(5) of it.
  EXPECT_FLOAT_EQ(fov_x(fov("diagonal")), 2 * std::atan(2 / std::sqrt(5.0f)) * 180 / kPi);
}

TEST(XmlSensor, FocalLengthIsThatOfASmallFormatCamera) {
  // 3:2 film, 50 mm: the 36 mm side spans 2 atan(18 / 50).
  const float expected = 2 * std::atan(18.0f / 50) * 180 / kPi;
  EXPECT_FLOAT_EQ(fov_x("", 300, 200), expected);
  EXPECT_FLOAT_EQ(fov_x("<string name='focalLength' value='50mm'/>", 300, 200), expected);
  EXPECT_FLOAT_EQ(fov_x("<string name='focal_length' value='18'/>", 300, 200), 90);
}

Filter filter_of(const std::string& rfilter) {
  return load_text("<scene><sensor type='perspective'><film type='hdrfilm'>" + rfilter +
                   "</film></sensor><shape type='cube'/></scene>")
      ->filter;
}

TEST(XmlSensor, CubicAndLanczosFilters) {
  const Filter mitchell = filter_of("<rfilter type='mitchell'/>");
  EXPECT_EQ(mitchell.kind, Filter::Kind::mitchell);
  EXPECT_EQ(mitchell.reach(), 2);
  EXPECT_EQ(mitchell.b, 1.0f / 3);
  EXPECT_EQ(mitchell.c, 1.0f / 3);
  const Filter tuned = filter_of(
      "<rfilter type='mitchell'><float name='B' value='0.5'/><float name='C' value='0.25'/>"
      "</rfilter>");
  EXPECT_EQ(tuned.b, 0.5f);
  EXPECT_EQ(tuned.c, 0.25f);
  const Filter catmull_rom = filter_of("<rfilter type='catmullrom'/>");
  EXPECT_EQ(catmull_rom.kind, Filter::Kind::mitchell);
  EXPECT_EQ(catmull_rom.b, 0);
  EXPECT_EQ(catmull_rom.c, 0.5f);
  EXPECT_EQ(filter_of("<rfilter type='lanczos'/>").reach(), 3);
  EXPECT_EQ(
      filter_of("<rfilter type='lanczos'><integer name='lobes' value='2'/></rfilter>").reach(), 2);
}

TEST(XmlSensor, DefaultsAreMitsubas) {
  const auto scene = load_text("<scene><sensor type='perspective'/><shape type='cube'/></scene>");
  EXPECT_EQ(scene->film.width, 768);
  EXPECT_EQ(scene->film.height, 576);
  EXPECT_EQ(scene->film.crop_width, 768);
  EXPECT_EQ(scene->filter.kind, Filter::Kind::gaussian);
  EXPECT_EQ(scene->filter.stddev, 0.5f);
  EXPECT_EQ(scene->filter.radius, 2);
  EXPECT_EQ(scene->max_depth, -1);
  EXPECT_FALSE(scene->hide_emitters);
}

TEST(XmlSensor, MirroredAndScaledPlacementIsKept) {
  const auto scene = load_text(
      "<scene><sensor type='perspective'><transform name='to_world'>"
      "<scale value='-3, 3, 3'/></transform></sensor>"
      "<shape type='cube'/></scene>");
  EXPECT_EQ(scene->camera_config.to_world.vector({1, 0, 0}), (Vec3{-3, 0, 0}));
}

TEST(XmlSensor, OnlyTheFirstIsUsed) {
  const auto scene = load_text(scene_with("<sensor type='thinlens'/>"));
  EXPECT_NE(scene->warnings.at(0).find("only the first sensor"), std::string::npos);
}

int max_depth(const std::string& integrator) {
  return load_text(scene_with(integrator))->max_depth;
}

TEST(XmlIntegrator, DepthIsReadThroughWrappers) {
  EXPECT_EQ(max_depth("<integrator type='direct'/>"), 2);
  EXPECT_EQ(max_depth("<integrator type='moment'><integrator type='path'>"
                      "<integer name='max_depth' value='8'/></integrator></integrator>"),
            8);
  EXPECT_EQ(
      max_depth("<integrator type='path'><integer name='maxDepth' value='-1'/>"
                "<integer name='rrDepth' value='5'/><boolean name='strictNormals' value='true'/>"
                "</integrator>"),
      -1);
}

TEST(XmlIntegrator, OthersAreReplacedWithAWarning) {
  const auto scene = load_text(scene_with("<integrator type='photonmapper'/>"));
  EXPECT_NE(scene->warnings.at(0).find("'photonmapper' is replaced"), std::string::npos);
}

}  // namespace
}  // namespace octolux::test
