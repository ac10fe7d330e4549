// Broken scenes: each must give one line "file:line: what is wrong", naming the line and helping.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

struct BrokenScene {
  std::string text;
  int line;
  std::string fragment;  // of the message
};

void expect_errors(const std::vector<BrokenScene>& scenes) {
  for (const BrokenScene& broken : scenes) {
    const SceneFiles files;
    files.write("scene.xml", broken.text);
    const std::string message = files.error();
    const std::string place = files.path() + ":" + std::to_string(broken.line) + ": ";
    EXPECT_EQ(message.substr(0, place.size()), place) << broken.text << "\nsays: " << message;
    EXPECT_NE(message.find(broken.fragment), std::string::npos)
        << broken.text << "\nsays: " << message << "\nwithout: " << broken.fragment;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

/// Line 2 of a scene that is otherwise right.
BrokenScene on_line_2(const std::string& body, const std::string& fragment) {
  return {scene_with(body), 2, fragment};
}

BrokenScene in_bsdf(const std::string& type, const std::string& body, const std::string& fragment) {
  return on_line_2("<bsdf type='" + type + "'>" + body + "</bsdf>", fragment);
}

BrokenScene in_shape(const std::string& type, const std::string& body,
                     const std::string& fragment) {
  return on_line_2("<shape type='" + type + "'>" + body + "</shape>", fragment);
}

BrokenScene in_sensor(const std::string& body, const std::string& fragment) {
  return {"<scene><shape type='cube'/>\n<sensor type='perspective'>" + body + "</sensor></scene>",
          2, fragment};
}

BrokenScene in_film(const std::string& body, const std::string& fragment) {
  return in_sensor("<film type='hdrfilm'>" + body + "</film>", fragment);
}

BrokenScene in_transform(const std::string& body, const std::string& fragment) {
  return in_shape("cube", "<transform name='to_world'>" + body + "</transform>", fragment);
}

TEST(XmlErrors, MalformedFiles) {
  expect_errors({
      {"<scene>\n<shape></scene>", 2, "malformed XML"},
      {"<scene>\n\n<shape type='cube'", 3, "malformed XML"},
      {"", 1, "malformed XML"},
      {"just text", 1, "malformed XML"},
      {"\n<mitsuba/>", 2, "unknown element 'mitsuba'"},
      {"<shape type='cube'/>", 1, "expected <scene>, found <shape>"},
      on_line_2("stray words", "unexpected text inside <scene>"),
      on_line_2("<shap type='cube'/>", "unknown element 'shap'"),
      on_line_2("<shap type='cube'/>", "(did you mean 'shape'?)"),
      on_line_2("<shape typ='cube'/>", "unknown <shape> attribute 'typ'; legal: id, name, type"),
      on_line_2("<shape/>", "<shape> needs the attribute 'type'"),
      on_line_2("<float name='x' value='1'/>", "<float> cannot stand at the top level"),
      on_line_2("<scene/>", "<scene> cannot stand at the top level"),
  });
}

TEST(XmlErrors, UnknownPlugins) {
  expect_errors({
      on_line_2("<bsdf type='difuse'/>", "unknown bsdf plug-in 'difuse'; legal: blendbsdf"),
      on_line_2("<bsdf type='difuse'/>", "(did you mean 'diffuse'?)"),
      on_line_2("<shape type='heightfield'/>", "unknown shape plug-in 'heightfield'"),
      on_line_2("<emitter type='collimated'/>",
                "unknown emitter plug-in 'collimated'; legal: area, con"),
      on_line_2("<texture type='perlin'/>", "unknown texture plug-in 'perlin'; legal: bitmap"),
      {"<scene><shape type='cube'/>\n<sensor type='fisheye'/></scene>", 2,
       "unknown sensor plug-in 'fisheye'; legal: orthographic"},
      in_sensor("<film type='specfilm'/>", "unknown film plug-in 'specfilm'; legal: hdrfilm, ldrf"),
      in_film("<rfilter type='sinc'/>", "unknown rfilter plug-in 'sinc'; legal: box, catmullrom"),
  });
}

TEST(XmlErrors, UnknownAndMisusedParameters) {
  expect_errors({
      in_bsdf("diffuse", "<rgb name='reflektance' value='1'/>",
              "unknown diffuse parameter 'reflektance'; legal: reflectance (did you mean"),
      in_bsdf("dielectric", "<float name='intIor2' value='1'/>", "unknown dielectric parameter"),
      in_shape("sphere", "<float name='radios' value='1'/>", "(did you mean 'radius'?)"),
      in_sensor("<float name='aperture' value='1'/>", "unknown perspective parameter 'aperture'"),
      in_film("<integer name='widht' value='1'/>", "(did you mean 'width'?)"),
      in_shape("sphere", "<float value='1'/>", "needs the attribute 'name'"),
      in_shape("sphere", "<float name='radius'/>", "<float> needs the attribute 'value'"),
      in_shape("sphere", "<float name='radius' value='1'/><float name='radius' value='2'/>",
               "the parameter 'radius' is given twice"),
      in_shape("sphere", "<string name='radius' value='1'/>",
               "the parameter 'radius' is <string>, expected <float>"),
      in_shape("sphere", "<film type='hdrfilm'/>", "a film cannot stand inside shape 'sphere'"),
      in_shape("obj", "", "the parameter 'filename' is missing"),
  });
}

TEST(XmlErrors, Numbers) {
  const auto radius = [](const std::string& value, const std::string& fragment) {
    return in_shape("sphere", "<float name='radius' value='" + value + "'/>", fragment);
  };
  expect_errors({
      radius("one", "'one' is not a number"),
      radius("1.5m", "'1.5m' is not a number"),
      radius("1 2", "is not a number"),
      radius("", "'' is not a number"),
      radius("nan", "not a finite number"),
      radius("inf", "not a finite number"),
      radius("1e400", "out of range"),
      radius("1e39", "out of range"),
      radius("0", "'radius' must be above 0"),
      radius("-1", "'radius' must be above 0"),
      in_film("<integer name='width' value='1.5'/>", "'1.5' is not an integer"),
      in_film("<integer name='width' value='99999999999'/>", "'width' is out of range"),
      in_shape("cube", "<boolean name='flip_normals' value='yes'/>",
               "'yes' is neither 'true' nor 'false'"),
      in_shape("sphere", "<point name='center' value='1, 2'/>", "does not have three numbers"),
      in_shape("sphere", "<point name='center'/>", "needs 'value', or 'x', 'y' and 'z'"),
  });
}

TEST(XmlErrors, Colours) {
  const auto color = [](const std::string& element, const std::string& fragment) {
    return in_bsdf("diffuse", element, fragment);
  };
  expect_errors({
      color("<rgb name='reflectance' value='0.1, 0.2'/>", "is not a colour"),
      color("<rgb name='reflectance' value=''/>", "is not a colour"),
      color("<rgb name='reflectance' value='-0.1'/>", "negative colour"),
      color("<rgb name='reflectance' value='#12345'/>", "not a colour of the form #rrggbb"),
      color("<rgb name='reflectance' value='#12345g'/>", "not a colour of the form #rrggbb"),
      color("<spectrum name='reflectance' value='400:1'/>", "at least two"),
      color("<spectrum name='reflectance' value='400:1, 0.5'/>", "wavelength:value"),
      color("<spectrum name='reflectance' value='500:1, 400:1'/>", "must increase"),
      color("<spectrum name='reflectance' value='400:1, 500:-1'/>", "negative value"),
      color("<rgb name='reflectance' value='nan, 0, 0'/>", "not a finite number"),
  });
}

TEST(XmlErrors, Transforms) {
  expect_errors({
      in_transform("<scale value='1, 1, 0'/>", "the transform 'to_world' is singular"),
      in_transform("<rotate y='1' angle='30'/><scale x='0'/><rotate z='1' angle='20'/>",
                   "singular"),
      in_transform("<matrix value='1 0 0 0 1 0'/>", "16 or 9 numbers, row by row; there are 6"),
      in_transform("<matrix value='1 0 0 0  0 1 0 0  0 0 1 0  0 0 1 1'/>", "last row"),
      in_transform("<rotate angle='90'/>", "<rotate> needs an axis"),
      in_transform("<rotate x='1'/>", "<rotate> needs the attribute 'angle'"),
      in_transform("<lookat origin='1,1,1' target='1,1,1' up='0,1,0'/>", "must differ"),
      in_transform("<lookat origin='0,0,0' target='0,1,0' up='0,1,0'/>", "parallel"),
      in_transform("<lookat origin='0,0,0' target='0,1,0'/>", "needs the attribute 'up'"),
      in_transform("<float name='x' value='1'/>", "<float> cannot stand inside <transform>"),
      in_shape("cylinder", "<point name='p0' x='1'/><point name='p1' x='1'/>", "must differ"),
      in_sensor("<transform name='to_world'><scale z='0'/></transform>", "singular"),
  });
}

TEST(XmlErrors, Bsdfs) {
  const auto alpha = [](const std::string& value) {
    return in_bsdf("roughconductor", "<float name='alpha' value='" + value + "'/>",
                   "'alpha' must be above 0");
  };
  expect_errors({
      alpha("0"),
      alpha("-0.1"),
      in_bsdf("dielectric", "<float name='int_ior' value='0'/>", "'int_ior' must be above 0"),
      in_bsdf("dielectric", "<string name='int_ior' value='diamnd'/>", "(did you mean 'diamond'?)"),
      in_bsdf("conductor", "<string name='material' value='Xx'/>", "unknown material 'Xx'"),
      in_bsdf("conductor", "<rgb name='eta' value='1'/>", "'eta' and 'k' go together"),
      in_bsdf("conductor", "<rgb name='eta' value='0'/><rgb name='k' value='0'/>", "both be 0"),
      in_bsdf("roughconductor", "<string name='distribution' value='phong'/>",
              "unknown distribution 'phong'; legal: beckmann, ggx"),
      in_bsdf("roughconductor",
              "<float name='alpha' value='.1'/><float name='alpha_u' value='.1'/>", "give either"),
      in_bsdf("roughplastic", "<texture name='alpha' type='checkerboard'/>",
              "a texture cannot be used for 'alpha'"),
      in_bsdf("roughdielectric",
              "<float name='int_ior' value='1.5'/><float name='ext_ior' value='1.5'/>",
              "needs different"),
      in_bsdf("twosided", "", "needs one or two nested <bsdf>; there are 0"),
      in_bsdf("twosided", "<bsdf type='dielectric'/>", "cannot hold a 'dielectric'"),
      in_bsdf("twosided", "<bsdf type='null'/>", "cannot hold a 'null'"),
      in_bsdf("twosided", "<bsdf type='difftrans'/>", "cannot hold a 'difftrans'"),
      in_bsdf("mask", "<bsdf type='diffuse'/><bsdf type='diffuse'/>", "there are 2"),
      in_shape("cube", "<bsdf type='diffuse'/><bsdf type='diffuse'/>", "takes only one bsdf"),
  });
}

TEST(XmlErrors, FilesAndReferences) {
  const auto file = [](const std::string& plugin, const std::string& name,
                       const std::string& fragment) {
    return on_line_2(plugin + "<string name='filename' value='" + name + "'/>" +
                         (plugin[1] == 's' ? "</shape>" : "</texture>"),
                     fragment);
  };
  expect_errors({
      file("<shape type='obj'>", "none.obj", "file not found: 'none.obj'; searched in"),
      file("<texture type='bitmap'>", "none.png", "file not found: 'none.png'; searched in"),
      on_line_2("<include filename='none.xml'/>", "file not found: 'none.xml'"),
      on_line_2("<include filename='scene.xml'/>", "the file includes itself"),
      on_line_2("<include/>", "<include> needs the attribute 'filename'"),
      on_line_2("<path value='nowhere'/>", "no such folder: 'nowhere'"),
      on_line_2("<bsdf type='diffuse' id='wall'/><shape type='cube'><ref id='wal'/></shape>",
                "unknown id 'wal'; legal: wall (did you mean 'wall'?)"),
      on_line_2("<shape type='cube'><ref name='bsdf'/></shape>", "<ref> needs the attribute 'id'"),
      on_line_2("<bsdf type='diffuse' id='a'/><bsdf type='diffuse' id='a'/>",
                "the id 'a' is taken"),
      on_line_2("<bsdf type='twosided' id='a'><ref id='a'/></bsdf>", "leads back to itself"),
      on_line_2("<bsdf type='twosided' id='a'><ref id='b'/></bsdf>"
                "<bsdf type='twosided' id='b'><ref id='a'/></bsdf>",
                "leads back to itself"),
      on_line_2("<shape type='$kind'/>", "unknown scene parameter 'kind'; legal: none"),
      on_line_2("<default name='kind' value='cube'/><shape type='$kimd'/>", "set one by <default>"),
      on_line_2("<default name='a'/>", "<default> needs the attribute 'value'"),
  });
}

TEST(XmlErrors, SensorsAndFilms) {
  const auto fov = [](const std::string& value) {
    return in_sensor("<float name='fov' value='" + value + "'/>", "between 0 and 180");
  };
  expect_errors({
      fov("0"),
      fov("-10"),
      fov("180"),
      in_sensor("<string name='fov_axis' value='z'/>", "unknown fov_axis 'z'; legal: diagonal"),
      in_sensor("<float name='fov' value='9'/><string name='focal_length' value='9'/>", "either"),
      in_sensor("<string name='focal_length' value='0mm'/>", "'focal_length' must be above 0"),
      in_sensor("<float name='near_clip' value='0'/>", "'near_clip' must be above 0"),
      in_sensor("<float name='near_clip' value='5'/><float name='far_clip' value='4'/>",
                "'far_clip' must be above 'near_clip'"),
      in_film("<integer name='width' value='0'/>", "'width' must be at least 1"),
      in_film("<integer name='height' value='-4'/>", "'height' must be at least 1"),
      in_film("<integer name='width' value='99999'/><integer name='height' value='99999'/>",
              "more than 2^28 pixels"),
      in_film("<integer name='crop_offset_x' value='768'/>", "lies outside the film"),
      in_film("<integer name='crop_width' value='769'/>", "wider than the film"),
      in_film("<rfilter type='gaussian'><float name='stddev' value='0'/></rfilter>", "above 0"),
      in_film("<rfilter type='lanczos'><integer name='lobes' value='0'/></rfilter>",
              "'lobes' must lie between 1 and 16"),
      in_film("<rfilter type='box'/><rfilter type='box'/>", "only one rfilter"),
      {"<scene>\n<shape type='cube'/></scene>", 1, "the scene has no sensor"},
      {"<scene><sensor type='perspective'/></scene>", 1, "the scene has no shapes"},
      {"<scene><integrator type='path'/>\n<integrator type='path'/></scene>", 2, "only one integr"},
      on_line_2("<integrator type='path'><integer name='max_depth' value='0'/></integrator>",
                "'max_depth' must be -1 (no limit) or at least 1"),
  });
}

TEST(XmlErrors, Emitters) {
  expect_errors({
      on_line_2("<emitter type='area'/>", "an area emitter needs a shape"),
      in_shape("cube", "<emitter type='point'/>", "an emitter 'point' cannot stand inside a shape"),
      in_shape("cube", "<emitter type='area'/><emitter type='area'/>", "takes only one emitter"),
      in_shape("cube", "<emitter type='area'><rgb name='radiance' value='-1'/></emitter>",
               "negative colour"),
      in_shape("cube", "<emitter type='area'><rgb name='radiants' value='1'/></emitter>",
               "(did you mean 'radiance'?)"),
      in_shape("cube", "<emitter type='area'><string name='radiance' value='1'/></emitter>",
               "is <string>, expected <rgb>"),
      on_line_2("<emitter type='constant'/><emitter type='constant'/>",
                "only one emitter that surrounds"),
      on_line_2("<emitter type='envmap'/>", "the parameter 'filename' is missing"),
  });
}

}  // namespace
}  // namespace octolux::test
