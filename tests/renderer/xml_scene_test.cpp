// What a scene file becomes: both dialects the same, every element of transforms, every spelling of
// colours.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/rng.h"
#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

// ---- both dialects

const char* const kCamelCase = R"(<scene version="0.6.0">
<integrator type="path"><integer name="maxDepth" value="5"/><boolean name="hideEmitters" value="true"/></integrator>
<sensor type="perspective"><float name="fov" value="30"/><string name="fovAxis" value="y"/>
  <float name="nearClip" value="0.5"/><float name="farClip" value="50"/>
  <float name="principalPointOffsetX" value="0.1"/>
  <transform name="toWorld"><lookAt origin="0, 0, -5" target="0, 0, 0" up="0, 1, 0"/></transform>
  <film type="ldrfilm"><integer name="width" value="64"/><integer name="height" value="32"/>
    <integer name="cropOffsetX" value="8"/><integer name="cropOffsetY" value="4"/>
    <integer name="cropWidth" value="16"/><integer name="cropHeight" value="12"/>
    <boolean name="highQualityEdges" value="true"/><string name="pixelFormat" value="rgb"/>
    <rfilter type="tent"/></film>
  <sampler type="ldsampler"><integer name="sampleCount" value="4"/></sampler></sensor>
<shape type="sphere"><float name="radius" value="2"/><boolean name="flipNormals" value="true"/>
  <transform name="toWorld"><rotate y="1" angle="90"/><translate x="1"/></transform>
  <bsdf type="roughconductor"><string name="distribution" value="ggx"/>
    <float name="alphaU" value="0.3"/><float name="alphaV" value="0.4"/>
    <rgb name="eta" value="1, 2, 3"/><rgb name="k" value="2"/>
    <rgb name="specularReflectance" value="0.5"/></bsdf></shape>
<shape type="rectangle"><bsdf type="roughplastic"><float name="intIOR" value="1.5"/>
  <string name="extIOR" value="air"/><rgb name="diffuseReflectance" value="0.1 0.2 0.3"/>
  <float name="alpha" value="0.3"/></bsdf>
  <emitter type="area"><spectrum name="radiance" value="3"/></emitter></shape>
</scene>)";

const char* const kSnakeCase = R"(<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="5"/><boolean name="hide_emitters" value="true"/></integrator>
<sensor type="perspective"><float name="fov" value="30"/><string name="fov_axis" value="y"/>
  <float name="near_clip" value="0.5"/><float name="far_clip" value="50"/>
  <float name="principal_point_offset_x" value="0.1"/>
  <transform name="to_world"><lookat origin="0, 0, -5" target="0, 0, 0" up="0, 1, 0"/></transform>
  <film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="32"/>
    <integer name="crop_offset_x" value="8"/><integer name="crop_offset_y" value="4"/>
    <integer name="crop_width" value="16"/><integer name="crop_height" value="12"/>
    <string name="pixel_format" value="rgb"/>
    <rfilter type="tent"/></film>
  <sampler type="independent"><integer name="sample_count" value="4"/></sampler></sensor>
<shape type="sphere"><float name="radius" value="2"/><boolean name="flip_normals" value="true"/>
  <transform name="to_world"><rotate value="0, 1, 0" angle="90"/><translate value="1, 0, 0"/></transform>
  <bsdf type="roughconductor"><string name="distribution" value="ggx"/>
    <float name="alpha_u" value="0.3"/><float name="alpha_v" value="0.4"/>
    <rgb name="eta" value="1, 2, 3"/><rgb name="k" value="2"/>
    <rgb name="specular_reflectance" value="0.5"/></bsdf></shape>
<shape type="rectangle"><bsdf type="roughplastic"><float name="int_ior" value="1.5"/>
  <string name="ext_ior" value="air"/><rgb name="diffuse_reflectance" value="0.1 0.2 0.3"/>
  <float name="alpha" value="0.3"/></bsdf>
  <emitter type="area"><rgb name="radiance" value="3"/></emitter></shape>
</scene>)";

void expect_same_bsdf(const Bsdf& a, const Bsdf& b) {
  EXPECT_EQ(a.lobes(), b.lobes());
  SurfacePoint at;
  Rng rng(1, Stream::test, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const auto direction = [&rng] {
      const float x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
      return normalize(Vec3{2 * x - 1, 2 * y - 1, z + 0.1f});
    };
    const Vec3 wo = direction(), wi = direction();
    const Rgb fa = a.f(at, wo, wi, Lobes::all, Carried::radiance);
    EXPECT_FALSE(is_black(fa));
    EXPECT_EQ(fa, b.f(at, wo, wi, Lobes::all, Carried::radiance));
  }
}

TEST(XmlScene, BothDialectsMeanTheSame) {
  const auto a = load_text(kCamelCase), b = load_text(kSnakeCase);
  EXPECT_TRUE(a->warnings.empty());
  EXPECT_TRUE(b->warnings.empty());
  for (const Scene* s : {a.get(), b.get()}) {
    EXPECT_EQ(s->max_depth, 5);
    EXPECT_TRUE(s->hide_emitters);
    EXPECT_EQ(s->film.width, 64);
    EXPECT_EQ(s->film.crop_x, 8);
    EXPECT_EQ(s->film.crop_height, 12);
    EXPECT_EQ(s->filter.kind, Filter::Kind::tent);
    EXPECT_EQ(s->camera_config.near_clip, 0.5f);
    EXPECT_EQ(s->camera_config.far_clip, 50);
    EXPECT_EQ(s->camera_config.principal_offset, (Vec2{0.1f, 0}));
    EXPECT_EQ(s->lights.size(), 1u);
    EXPECT_EQ(s->shapes.at(1).light, 0);
    EXPECT_EQ(s->shapes.at(0).light, -1);
  }
  EXPECT_EQ(a->camera_config.fov_x_degrees, b->camera_config.fov_x_degrees);
  EXPECT_EQ(a->camera_config.to_world.m, b->camera_config.to_world.m);
  const auto &qa = std::get<Quadric>(a->shapes[0].geometry),
             &qb = std::get<Quadric>(b->shapes[0].geometry);
  EXPECT_TRUE(qa.flip && qb.flip);
  EXPECT_EQ(qa.to_world.m, qb.to_world.m);
  EXPECT_EQ(a->lights[0]->power(), b->lights[0]->power());
  ASSERT_EQ(a->bsdfs.size(), b->bsdfs.size());
  for (std::size_t i = 0; i < a->bsdfs.size(); ++i) expect_same_bsdf(*a->bsdfs[i], *b->bsdfs[i]);
}

// ---- transforms, seen through a disk's placement

Affine transform_of(const std::string& elements) {
  const auto scene = load_text(
      "<scene><sensor type='perspective'/><shape type='disk'>"
      "<transform name='to_world'>" +
      elements + "</transform></shape></scene>");
  return std::get<Quadric>(scene->shapes.at(0).geometry).to_world;
}

void expect_maps(const std::string& elements, Vec3 from, Vec3 to) {
  const Vec3 p = transform_of(elements).point(from);
  const float tolerance = 8 * 0x1p-24f * std::max(1.0f, max_component(abs(to)));
  EXPECT_NEAR(p.x, to.x, tolerance) << elements;
  EXPECT_NEAR(p.y, to.y, tolerance) << elements;
  EXPECT_NEAR(p.z, to.z, tolerance) << elements;
}

TEST(XmlTransform, EveryElementInEverySpelling) {
  const Vec3 p{1, 2, 3};
  expect_maps("", p, p);
  expect_maps("<translate x='10' z='-1'/>", p, {11, 2, 2});
  expect_maps("<translate value='10, 0 -1'/>", p, {11, 2, 2});
  expect_maps("<scale value='2'/>", p, {2, 4, 6});
  expect_maps("<scale value='2, 3, 4'/>", p, {2, 6, 12});
  expect_maps("<scale y='5'/>", p, {1, 10, 3});
  expect_maps("<rotate z='1' angle='90'/>", p, {-2, 1, 3});
  expect_maps("<rotate value='0 0 2' angle='90'/>", p, {-2, 1, 3});
  expect_maps("<matrix value='1 0 0 5  0 2 0 6  0 0 3 7  0 0 0 1'/>", p, {6, 10, 16});
  expect_maps("<matrix value='0 1 0  1 0 0  0 0 1'/>", p, {2, 1, 3});
  expect_maps("<lookat origin='0,0,5' target='0,0,6' up='0,1,0'/>", p, {1, 2, 8});
  expect_maps("<lookAt origin='0 0 5' target='0 0 6' up='0 1 0'/>", p, {1, 2, 8});
}

TEST(XmlTransform, LaterElementsApplyAfterEarlierOnes) {
  expect_maps("<scale value='2'/><translate x='1'/>", {1, 1, 1}, {3, 2, 2});
  expect_maps("<translate x='1'/><scale value='2'/>", {1, 1, 1}, {4, 2, 2});
  expect_maps("<rotate y='1' angle='120'/><scale x='2' y='2' z='2'/><translate x='-4' z='6'/>",
              {0, 1, 0}, {-4, 2, 6});
}

// ---- colours, seen through a diffuse reflectance or a constant light

Rgb reflectance_of(const std::string& color) {
  const auto scene = load_text(scene_with("<bsdf type='diffuse' id='d'>" + color + "</bsdf>"));
  return scene->bsdfs.at(1)->albedo(SurfacePoint{});  // 0 is the cube's default
}

TEST(XmlColor, EverySpelling) {
  EXPECT_EQ(reflectance_of(""), Rgb(0.5f));
  EXPECT_EQ(reflectance_of("<rgb name='reflectance' value='0.1, 0.2, 0.3'/>"),
            Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(reflectance_of("<rgb name='reflectance' value='.1 .2 .3'/>"), Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(reflectance_of("<spectrum name='reflectance' value='0.25'/>"), Rgb(0.25f));
  EXPECT_EQ(reflectance_of("<spectrum name='reflectance' value='.9 .7 .5'/>"),
            Rgb(0.9f, 0.7f, 0.5f));
  EXPECT_EQ(reflectance_of("<float name='reflectance' value='0.25'/>"), Rgb(0.25f));
  EXPECT_EQ(reflectance_of("<color name='reflectance' value='+2.5e-001'/>"), Rgb(0.25f));
  EXPECT_EQ(reflectance_of("<rgb name='reflectance' value='#ff0000'/>"), Rgb(1, 0, 0));
  const Rgb srgb = reflectance_of("<srgb name='reflectance' value='0.5, 0, 1'/>");
  EXPECT_NEAR(srgb.r, 0.21404f, 1e-5f);
  EXPECT_FLOAT_EQ(srgb.b, 1);
  const Rgb hex = reflectance_of("<srgb name='reflectance' value='#808080'/>");
  EXPECT_NEAR(hex.g, 0.21586f, 1e-5f);  // 128 / 255
  const Rgb white = reflectance_of("<spectrum name='reflectance' value='360:1, 830:1'/>");
  EXPECT_NEAR(white.g, 1, 1e-3f);
}

TEST(XmlColor, ReflectanceAboveOneIsClampedWithAWarning) {
  const auto scene = load_text(
      scene_with("<bsdf type='diffuse'><rgb name='reflectance' value='2, 0.5, 0'/></bsdf>"));
  EXPECT_EQ(scene->bsdfs.at(1)->albedo(SurfacePoint{}), Rgb(1, 0.5f, 0));
  ASSERT_FALSE(scene->warnings.empty());
  EXPECT_NE(scene->warnings[0].find("scene.xml:2: 'reflectance' is above 1"), std::string::npos);
}

}  // namespace
}  // namespace octolux::test
