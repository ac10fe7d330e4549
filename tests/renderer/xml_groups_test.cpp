// Shape groups and instances of scene files.
#include <gtest/gtest.h>

#include "core/constants.h"
#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

const std::string kSensor = "<scene version='3.0.0'><sensor type='perspective'/>\n";
const std::string kGroup =
    "<shape type='shapegroup' id='g'><shape type='rectangle'/>"
    "<shape type='sphere'><float name='radius' value='0.5'/></shape></shape>\n";

std::string instance(const std::string& transform = "", const std::string& id = "g") {
  return "<shape type='instance'><ref id='" + id + "'/><transform name='to_world'>" + transform +
         "</transform></shape>\n";
}

std::unique_ptr<Scene> load(const std::string& body) {
  auto scene = load_text(kSensor + body + "</scene>");
  scene->complete();
  return scene;
}

std::string complaint(const std::string& body) {
  const SceneFiles files;
  files.write("scene.xml", kSensor + body + "</scene>");
  return files.error();
}

bool hits(const Scene& scene, Vec3 from, Vec3 direction) {
  return scene.caster->closest({from, direction}).has_value();
}

TEST(XmlGroups, SeveralInstancesShareTheirShapes) {
  const auto scene =
      load(kGroup + instance("<translate x='5'/>") +
           instance("<scale value='2'/><translate x='-5'/>") + "<shape type='disk'/>");
  ASSERT_EQ(scene->shapes.size(), 3u);
  EXPECT_EQ(scene->shapes[0].group, -1);  // the disk
  EXPECT_EQ(scene->shapes[1].group, 0);
  EXPECT_EQ(scene->instances.size(), 2u);
  EXPECT_TRUE(hits(*scene, {5.9f, 0, 1}, {0, 0, -1}));
  EXPECT_FALSE(hits(*scene, {6.1f, 0, 1}, {0, 0, -1}));
  EXPECT_TRUE(hits(*scene, {-6.9f, 0, 1}, {0, 0, -1}));
  const auto hit = scene->caster->closest({{-5, 0, 3}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 2, 1e-5f);  // the sphere, twice as large
  EXPECT_EQ(scene->caster->surface(*hit).ng, (Vec3{0, 0, 1}));
  // Two rectangles of 4 and 16, two spheres of pi and 4 pi, the disk.
  EXPECT_NEAR(scene->total_area, 20 + 6 * kPi, 1e-2);
  EXPECT_EQ(&scene->bsdf(hit->shape), scene->bsdfs[0].get());
}

TEST(XmlGroups, OnePlacementNeedsNoInstance) {
  const auto scene = load(kGroup + instance("<scale x='-1'/><translate x='5'/>"));
  EXPECT_TRUE(scene->instances.empty());
  ASSERT_EQ(scene->shapes.size(), 2u);
  EXPECT_EQ(scene->shapes[0].group, -1);
  const auto hit = scene->caster->closest({{5.9f, 0, 1}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(scene->caster->surface(*hit).ng, (Vec3{0, 0, 1}));  // mirrored, still in front
}

TEST(XmlGroups, NestedTransformsMultiply) {
  const std::string row = "<shape type='shapegroup' id='row'><shape type='disk'/>" +
                          instance("<translate x='3'/>") + instance("<translate x='6'/>") +
                          "</shape>";
  const auto scene = load(kGroup + row + instance("<scale value='2'/>", "row") +
                          instance("<scale value='2'/><translate y='20'/>", "row"));
  EXPECT_EQ(scene->instances.size(), 6u);
  for (const float y : {0.0f, 20.0f}) {
    for (const float x : {0.0f, 6.0f, 12.0f}) {
      EXPECT_TRUE(hits(*scene, {x + 1.9f, y, 1}, {0, 0, -1})) << x << " " << y;
      EXPECT_FALSE(hits(*scene, {x + 2.1f, y, 1}, {0, 0, -1})) << x << " " << y;
    }
  }
}

TEST(XmlGroups, EveryPlaceOfAnEmitterIsALight) {
  const std::string lamp =
      "<shape type='shapegroup' id='lamp'><shape type='disk'><emitter type='area'>"
      "<rgb name='radiance' value='1'/></emitter></shape><shape type='cube'/></shape>";
  const auto scene =
      load(lamp + instance("<translate x='9'/>", "lamp") + instance("<scale value='2'/>", "lamp"));
  ASSERT_EQ(scene->lights.size(), 2u);
  EXPECT_NEAR(scene->lights[0]->power().r, kPi * kPi, 1e-4f);
  EXPECT_NEAR(scene->lights[1]->power().r, 4 * kPi * kPi, 1e-3f);
  EXPECT_EQ(scene->instances.size(), 2u);  // of the cube
  ASSERT_EQ(scene->shapes.size(), 3u);
  for (std::uint32_t i = 0; i < scene->area_light_of_shape.size(); ++i) {
    EXPECT_EQ(scene->area_light_of_shape[i] != nullptr, i < 3 && scene->shapes[i].light >= 0);
  }
  EXPECT_EQ(scene->area_light_of_shape.size(), 5u);
}

TEST(XmlGroups, ShearedPlacesAreCopies) {
  const auto scene = load(kGroup + instance("<rotate z='1' angle='45'/><scale x='1000'/>") +
                          instance("<translate x='5'/>"));
  EXPECT_EQ(scene->instances.size(), 1u);
  EXPECT_EQ(scene->shapes.size(), 4u);
}

TEST(XmlGroups, MistakesAreNamed) {
  EXPECT_NE(complaint("<shape type='instance'/>").find("scene.xml:2: an instance needs one"),
            std::string::npos);
  EXPECT_NE(complaint("<shape type='cube' id='c'/>\n" + instance("", "c")).find(":3: an instance"),
            std::string::npos);
  EXPECT_NE(complaint("<shape type='shapegroup' id='g'/>").find("the shapegroup is empty"),
            std::string::npos);
  EXPECT_NE(complaint("<shape type='shapegroup' id='a'>" + kGroup + "</shape>")
                .find("cannot stand inside another"),
            std::string::npos);
  EXPECT_NE(complaint("<shape type='shapegroup' id='g'><shape type='cube'/>" + instance() +
                      "</shape>" + instance())
                .find("leads back to itself"),
            std::string::npos);
  EXPECT_NE(complaint(kGroup + "<shape type='instance'><ref id='g'/><bsdf type='diffuse'/></shape>")
                .find("a bsdf cannot stand inside shape 'instance'"),
            std::string::npos);
}

TEST(XmlGroups, UnusedOnesAreNotInThePicture) {
  const auto scene = load(kGroup + "<shape type='cube'/>");
  EXPECT_EQ(scene->shapes.size(), 1u);
  ASSERT_FALSE(scene->warnings.empty());
  EXPECT_NE(scene->warnings[0].find("no instance uses this shapegroup"), std::string::npos);
}

}  // namespace
}  // namespace octolux::test
