// The plug-ins of both dialects that make materials and emitters: what they become, and that
// mistakes in them are one clear error.
#include <gtest/gtest.h>

#include "core/constants.h"
#include "core/image_io.h"
#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

std::string scene_of_version(const std::string& version, const std::string& body) {
  return "<scene version=\"" + version +
         "\"><sensor type=\"perspective\"/><shape type=\"cube\"/>\n" + body + "</scene>\n";
}

std::string error_of(const std::string& body) {
  const SceneFiles files;
  files.write("scene.xml", scene_with(body));
  return files.error();
}

TEST(XmlMaterials, AdaptersAndNewKindsLoadInBothDialects) {
  const auto scene = load_text(scene_of_version("0.6.0", R"(
    <bsdf type="phong"><float name="exponent" value="100"/>
      <spectrum name="specularReflectance" value=".3"/></bsdf>
    <bsdf type="coating"><float name="intIOR" value="1.075"/><bsdf type="diffuse"/></bsdf>
    <bsdf type="bump"><texture type="scale"><float name="scale" value="2"/>
      <texture type="checkerboard"/></texture><bsdf type="plastic"/></bsdf>
    <bsdf type="mixturebsdf"><string name="weights" value="0.7, 0.2"/>
      <bsdf type="diffuse"/><bsdf type="conductor"/></bsdf>
    <bsdf type="blendbsdf"><float name="weight" value="0.25"/>
      <bsdf type="diffuse"/><bsdf type="roughconductor"/></bsdf>
    <bsdf type="roughdiffuse"><rgb name="diffuseReflectance" value="0.3, 0.4, 0.5"/>
      <float name="alpha" value="0.5"/><boolean name="useFastApprox" value="true"/></bsdf>
    <bsdf type="difftrans"><texture name="transmittance" type="checkerboard"/></bsdf>
    <bsdf type="null"/>
    <emitter type="constant"/>)"));
  EXPECT_TRUE(scene->warnings.empty()) << scene->warnings.front();
  const auto modern = load_text(scene_with(R"(
    <bsdf type="normalmap"><texture name="normalmap" type="rawconstant">
      <vector name="value" value="0.5, 0.5, 1"/></texture><bsdf type="diffuse"/></bsdf>
    <bsdf type="bumpmap"><float name="scale" value="0.02"/>
      <texture name="arbitrary" type="checkerboard"/><bsdf type="diffuse"/></bsdf>
    <bsdf type="principled"><rgb name="base_color" value="0.3,0.6,0.8"/>
      <texture name="anisotropic" type="checkerboard"/><float name="specular" value="0.4"/></bsdf>
    <bsdf type="roughconductor"><texture name="alpha_u" type="checkerboard"/>
      <float name="alpha_v" value="0.3"/></bsdf><emitter type="constant"/>)"));
  EXPECT_TRUE(modern->warnings.empty()) << modern->warnings.front();
}

TEST(XmlMaterials, MistakesAreOneClearError) {
  const std::pair<const char*, const char*> cases[] = {
      {"<bsdf type='bumpmap'><bsdf type='diffuse'/></bsdf>", "needs one nested <texture>"},
      {"<bsdf type='blendbsdf'><bsdf type='diffuse'/></bsdf>", "needs two nested <bsdf>"},
      {"<bsdf type='mixturebsdf'><bsdf type='diffuse'/></bsdf>", "'weights' needs a number"},
      {"<bsdf type='bumpmap'><texture type='checkerboard'/><bsdf type='normalmap'>"
       "<texture type='checkerboard'/><bsdf type='diffuse'/></bsdf></bsdf>",
       "cannot hold a normalmap"},
      {"<bsdf type='twosided'><bsdf type='bumpmap'><texture type='checkerboard'/>"
       "<bsdf type='dielectric'/></bsdf></bsdf>",
       "which lets light through"},
      {"<bsdf type='phong'><float name='shininess' value='3'/></bsdf>", "shininess"},
      {"<bsdf type='principled'><float name='eta' value='1.5'/>"
       "<float name='specular' value='.5'/></bsdf>",
       "give either 'eta' or 'specular'"},
      {"<emitter type='spot'><float name='cutoff_angle' value='95'/></emitter>", "below 90"},
      {"<emitter type='sky'><float name='turbidity' value='11'/></emitter>", "between 1 and 10"},
      {"<emitter type='sky'><float name='hour' value='23'/></emitter>", "below the horizon"},
      {"<emitter type='sky'/><emitter type='constant'/>", "only one emitter that surrounds"},
      {"<emitter type='directional'><vector name='direction' value='0,0,0'/></emitter>",
       "must not be zero"},
      {"<emitter type='point'><spectrum name='intensity' type='blackbody'/></emitter>",
       "needs <float name=\"temperature\">"},
  };
  for (const auto& [body, message] : cases) {
    const std::string error = error_of(body);
    EXPECT_NE(error.find(message), std::string::npos) << body << "\n" << error;
    EXPECT_NE(error.find("scene.xml:2"), std::string::npos) << error;
  }
}

TEST(XmlMaterials, ACheckerboardIsCutToOneOnlyWhereItReflects) {
  const std::string board =
      "type='checkerboard'><rgb name='color0' value='3'/><rgb name='color1' "
      "value='1'/></texture>";
  const auto lamp =
      load_text(scene_with("<shape type='rectangle'><emitter type='area'><texture "
                           "name='radiance' " +
                           board + "</emitter></shape>"));
  EXPECT_TRUE(lamp->warnings.empty());
  // The mean of 3 and 1 over 2 x 2; integrated over 128 x 128 points.
  EXPECT_NEAR(lamp->lights[0]->power().r, 2 * 4 * kPi, 2 * 4 * kPi / 128);
  const auto wall = load_text(scene_with("<bsdf type='diffuse'><texture name='reflectance' " +
                                         board + "</bsdf><emitter type='constant'/>"));
  ASSERT_EQ(wall->warnings.size(), 1u);
  EXPECT_NE(wall->warnings[0].find("values above 1; clamped"), std::string::npos);
}

TEST(XmlMaterials, ProjectorsAndThinSheetsLoad) {
  const auto scene = load_text(scene_with(R"(
    <bsdf type="principledthin"><float name="diff_trans" value="1.4"/>
      <texture name="spec_trans" type="checkerboard"/></bsdf>
    <emitter type="projector"><float name="fov" value="90"/><float name="scale" value="2"/>
      <rgb name="irradiance" value="0.5"/></emitter>)"));
  EXPECT_TRUE(scene->warnings.empty());
  EXPECT_NEAR(scene->lights[0]->power().g, kPi * 4, 1e-5f);  // a screen of 2 x 2 at distance 1
  EXPECT_NE(error_of("<emitter type='projector'/>").find("'irradiance' is missing"),
            std::string::npos);
}

TEST(XmlMaterials, PathGuidingIsIgnoredWithOneWarning) {
  const auto scene = load_text(
      scene_with("<bsdf type='diffuse' id='a'><boolean name='usePathGuiding' value='false'/></bsdf>"
                 "<bsdf type='diffuse' id='b'><boolean name='usePathGuiding' value='true'/></bsdf>"
                 "<emitter type='constant'/>"));
  ASSERT_EQ(scene->warnings.size(), 1u);
  EXPECT_NE(scene->warnings[0].find("use_path_guiding"), std::string::npos);
}

TEST(XmlEmitters, BlackBodiesInBothDialects) {
  const auto old_one =
      load_text(scene_of_version("0.6.0",
                                 "<emitter type='point'><blackbody name='intensity' "
                                 "temperature='3000K' scale='2'/></emitter>"));
  const auto modern = load_text(scene_with(
      "<emitter type='point'><spectrum name='intensity' type='blackbody'>"
      "<float name='temperature' value='3000'/><float name='scale' value='2'/></spectrum>"
      "</emitter>"));
  EXPECT_EQ(old_one->lights[0]->power(), modern->lights[0]->power());
  EXPECT_GT(modern->lights[0]->power().r, modern->lights[0]->power().b);
}

/// Irradiance of a plane facing up under what surrounds the scene: by its own sampling.
Rgb irradiance(const Scene& scene) {
  Rgb sum(0);
  constexpr std::uint32_t n = 1 << 16;
  for (const EnvironmentLight* light : scene.environment) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const Vec2 u{(static_cast<float>(i) + 0.5f) / n, static_cast<float>((i * 40503u) % n) / n};
      const auto s = light->sample({}, u);
      if (s && s->wi.y > 0) sum += s->radiance * (s->wi.y / s->pdf_w);
    }
  }
  return sum / n;
}

std::unique_ptr<Scene> daylight(const std::string& type, const std::string& parameters) {
  return load_text(scene_of_version(
      "0.6.0", "<emitter type='" + type + "'><vector name='sunDirection' value='0.3, 0.8, 0.2'/>" +
                   parameters + "</emitter>"));
}

TEST(XmlEmitters, TheSunLosesNothingWhateverItsMapAndRadius) {
  const auto point = daylight("sun", "<float name='sunRadiusScale' value='0'/>");
  ASSERT_TRUE(point->environment.empty());
  const auto s = point->lights[0]->sample({}, {0.5f, 0.5f});
  ASSERT_TRUE(s && s->delta);
  const Vec3 sun = normalize({0.3f, 0.8f, 0.2f});
  EXPECT_NEAR(dot(s->wi, sun), 1, 1e-5);
  const float expected = s->radiance.g * sun.y;
  for (const char* parameters : {"", "<integer name='resolution' value='64'/>",
                                 "<float name='sunRadiusScale' value='8'/>"}) {
    const auto scene = daylight("sun", parameters);
    ASSERT_FALSE(scene->environment.empty()) << parameters;
    // The map's texels are up to 6 degrees wide: their cosines differ from the sun's.
    EXPECT_NEAR(irradiance(*scene).g, expected, 0.03f * expected) << parameters;
  }
}

TEST(XmlEmitters, SunskyIsTheSumOfSunAndSkyWithItsScales) {
  const float sun = irradiance(*daylight("sun", "")).g;
  const float sky = irradiance(*daylight("sky", "")).g;
  EXPECT_GT(sun, 3 * sky);
  EXPECT_GT(sky, 0);
  const auto both = daylight("sunsky", "");
  EXPECT_NEAR(irradiance(*both).g, sun + sky, 0.01f * (sun + sky));
  const auto scaled =
      daylight("sunsky", "<float name='sunScale' value='0'/><float name='skyScale' value='3'/>");
  EXPECT_NEAR(irradiance(*scaled).g, 3 * sky, 0.01f * 3 * sky);
}

TEST(XmlTextures, FilesAreFoundWhateverTheirCase) {
  const SceneFiles files;
  files.write("Textures/placeholder", "");
  Image image(2, 1);
  image.at(0, 0) = Rgb(1);
  write_png(files.path("Textures/Wood.PNG"), image);
  files.write("scene.xml",
              scene_with("<bsdf type='diffuse'><texture name='reflectance' "
                         "type='bitmap'><string name='filename' "
                         "value='textures\\wood.png'/><string name='wrap_mode_u' "
                         "value='clamp'/></texture></bsdf><emitter type='constant'/>"));
  EXPECT_EQ(files.error(), "");
  EXPECT_EQ(files.load()->textures.size(), 1u);
}

TEST(XmlTextures, BrightTexturesAreCutForReflectanceButNotForLamps) {
  const SceneFiles files;
  Image image(1, 1);
  image.at(0, 0) = {4, 2, 0.5f};
  write_exr(files.path("t.exr"), {1, 1, {rgb_layer("", image)}, {}});
  const std::string texture = " type='bitmap'><string name='filename' value='t.exr'/></texture>";
  files.write("scene.xml",
              scene_with("<bsdf type='diffuse'><texture name='reflectance'" + texture +
                         "</bsdf><shape type='rectangle'><emitter type='area'><texture "
                         "name='radiance'" +
                         texture + "</emitter></shape>"));
  const auto scene = files.load();
  EXPECT_EQ(scene->bsdfs[1]->albedo(SurfacePoint{}), Rgb(1, 1, 0.5f));
  EXPECT_FLOAT_EQ(scene->lights[0]->power().r, 4 * 4 * kPi);
  EXPECT_EQ(scene->warnings.size(), 1u);
}

}  // namespace
}  // namespace octolux::test
