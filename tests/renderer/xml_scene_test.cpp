// What the elements of a scene file become: both dialects, transforms, colours, shapes, lights,
// camera and film.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

// ---- shapes

const TriangleMesh& mesh_of(const Scene& scene) {
  return std::get<TriangleMesh>(scene.shapes.at(0).geometry);
}

std::unique_ptr<Scene> load_shape(const std::string& type, const std::string& parameters) {
  return load_text("<scene><sensor type='perspective'/><shape type='" + type + "'>" + parameters +
                   "</shape></scene>");
}

Vec3 triangle_normal(const TriangleMesh& mesh, std::size_t i) {
  const auto& t = mesh.triangles[i];
  const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
  return normalize(cross(b - a, c - a));
}

TEST(XmlShape, RectangleFacesPlusZWithTextureFromItsLowerLeft) {
  const auto scene = load_shape("rectangle", "");
  const TriangleMesh& mesh = mesh_of(*scene);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(area(scene->shapes[0]), 4, 1e-6);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(triangle_normal(mesh, i), (Vec3{0, 0, 1}));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_EQ(mesh.uvs[i].x, (mesh.positions[i].x + 1) / 2);
    EXPECT_EQ(mesh.uvs[i].y, (mesh.positions[i].y + 1) / 2);
  }
}

TEST(XmlShape, MirroringKeepsTheFrontAndFlippingTurnsIt) {
  const char* mirror = "<transform name='to_world'><scale x='-1'/></transform>";
  const char* flip = "<boolean name='flip_normals' value='true'/>";
  const auto normal = [](const std::string& parameters) {
    return triangle_normal(mesh_of(*load_shape("rectangle", parameters)), 0);
  };
  EXPECT_EQ(normal(mirror), (Vec3{0, 0, 1}));
  EXPECT_EQ(normal(flip), (Vec3{0, 0, -1}));
  EXPECT_EQ(normal(std::string(mirror) + flip), (Vec3{0, 0, -1}));
}

TEST(XmlShape, CubeFacesOutwardsEvenMirrored) {
  for (const char* parameters :
       {"", "<transform name='to_world'><scale x='-2' y='3' z='1'/></transform>"}) {
    const auto scene = load_shape("cube", parameters);
    const TriangleMesh& mesh = mesh_of(*scene);
    ASSERT_EQ(mesh.triangles.size(), 12u);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (std::size_t i = 0; i < 12; ++i) {
      const Vec3 corner = mesh.positions[mesh.triangles[i][0]];
      EXPECT_GT(dot(triangle_normal(mesh, i), corner), 0);
    }
  }
  EXPECT_NEAR(area(load_shape("cube", "")->shapes[0]), 24, 1e-5);
}

TEST(XmlShape, SphereTakesCenterAndRadiusThenToWorld) {
  const auto scene = load_shape("sphere",
                                "<point name='center' x='1'/><float name='radius' value='2'/>"
                                "<transform name='to_world'><scale value='10'/></transform>");
  const auto& q = std::get<Quadric>(scene->shapes[0].geometry);
  EXPECT_EQ(q.kind, Quadric::Kind::sphere);
  EXPECT_EQ(q.to_world.point({0, 0, 0}), (Vec3{10, 0, 0}));
  EXPECT_EQ(q.to_world.point({0, 1, 0}), (Vec3{10, 20, 0}));
}

TEST(XmlShape, CylinderRunsFromP0ToP1) {
  const auto scene =
      load_shape("cylinder",
                 "<point name='p0' value='1, 2, 3'/><point name='p1' value='1, 7, 3'/>"
                 "<float name='radius' value='0.5'/>");
  const auto& q = std::get<Quadric>(scene->shapes[0].geometry);
  EXPECT_EQ(q.kind, Quadric::Kind::cylinder);
  EXPECT_EQ(q.to_world.point({0, 0, 0}), (Vec3{1, 2, 3}));
  EXPECT_EQ(q.to_world.point({0, 0, 1}), (Vec3{1, 7, 3}));
  EXPECT_NEAR(length(q.to_world.vector({1, 0, 0})), 0.5f, 1e-6f);
  EXPECT_GT(q.to_world.determinant(), 0);
}

TEST(XmlShape, EmittersMayBeSharedByReference) {
  const auto scene = load_text(
      "<scene><sensor type='perspective'/>"
      "<shape type='rectangle'><ref id='e'/></shape><shape type='sphere'><ref id='e'/></shape>"
      "<emitter type='area' id='e'><rgb name='radiance' value='1'/></emitter></scene>");
  ASSERT_EQ(scene->lights.size(), 2u);
  // Power pi * area * radiance of the two.
  EXPECT_NEAR(scene->lights[scene->shapes[0].light]->power().r, 4 * kPi, 1e-4f);
  EXPECT_NEAR(scene->lights[scene->shapes[1].light]->power().r, 4 * kPi * kPi, 1e-2f);
}

TEST(XmlEmitter, PointAndConstant) {
  const auto scene = load_text(
      scene_with("<emitter type='point'><point name='position' x='-4' y='0.0' z='6'/>"
                 "<rgb name='intensity' value='300'/></emitter><emitter type='constant'/>"));
  ASSERT_EQ(scene->lights.size(), 2u);
  EXPECT_NEAR(scene->lights[0]->power().g, 300 * 4 * kPi, 1e-2f);
  ASSERT_NE(scene->environment, nullptr);
  EXPECT_EQ(scene->environment->radiance({0, 0, 1}), Rgb(1));
}

TEST(XmlEmitter, BlackOnesAreLeftOut) {
  const auto scene =
      load_text(scene_with("<emitter type='constant'><rgb name='radiance' value='0'/></emitter>"));
  EXPECT_TRUE(scene->lights.empty());
  EXPECT_EQ(scene->warnings.size(), 2u);  // the black one, and that nothing emits
}

// ---- camera, film, integrator

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
  EXPECT_EQ(max_depth("<integrator type='path'><integer name='maxDepth' value='-1'/>"
                      "<integer name='rrDepth' value='5'/><float name='made_up' value='1'/>"
                      "</integrator>"),
            -1);
}

TEST(XmlIntegrator, OthersAreReplacedWithAWarning) {
  const auto scene = load_text(scene_with("<integrator type='photonmapper'/>"));
  EXPECT_NE(scene->warnings.at(0).find("'photonmapper' is replaced"), std::string::npos);
}

}  // namespace
}  // namespace octolux::test
