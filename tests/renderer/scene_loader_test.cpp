// Choosing the loader, and errors that arise in files other than the scene's own.
#include "renderer/scene_loader.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/renderer/xml_testing.h"

namespace octolux::test {
namespace {

/// Errors inside data files name the data file.
TEST(SceneErrors, DataFiles) {
  const SceneFiles files;
  files.write("bad.obj", "v 0 0 0\nv 1 0 0\nv nan 0 0\nf 1 2 3\n");
  files.write("empty.obj", "");
  files.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  files.write("noise.png", "this is no picture");
  for (const char* name : {"bad.obj", "empty.obj", "flat.obj"}) {
    files.write("scene.xml", scene_with("<shape type='obj'><string name='filename' value='" +
                                        std::string(name) + "'/></shape>"));
    EXPECT_NE(files.error().find(name), std::string::npos) << files.error();
  }
  files.write("scene.xml", scene_with("<texture type='bitmap'><string name='filename' "
                                      "value='noise.png'/></texture>"));
  EXPECT_NE(files.error().find("noise.png"), std::string::npos) << files.error();
}

TEST(SceneErrors, IncludedFilesAreNamed) {
  const SceneFiles files;
  files.write("scene.xml", scene_with("<include filename='a.xml'/>"));
  files.write("a.xml", "<scene>\n\n<bsdf type='difuse'/></scene>");
  EXPECT_NE(files.error().find("a.xml:3: unknown bsdf"), std::string::npos) << files.error();
  files.write("a.xml", "<scene>\n<include filename='scene.xml'/></scene>");
  EXPECT_NE(files.error().find("a.xml:2: the file includes itself"), std::string::npos)
      << files.error();
}

TEST(SceneErrors, DefinesNobodyUses) {
  const SceneFiles files;
  files.write("scene.xml", "<scene><default name='spp' value='4'/></scene>");
  EXPECT_NE(files.error({{"sp", "16"}}).find("unknown -D parameter 'sp'; legal: spp (did you"),
            std::string::npos)
      << files.error({{"sp", "16"}});
}

TEST(LoadScene, ChoosesByExtension) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      load_scene(path, {});
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message("scene.blend").find("not '.blend'"), std::string::npos);
  EXPECT_NE(message("scene").find("an .xml (Mitsuba) or .obj (Wavefront) file"), std::string::npos);
  EXPECT_NE(message("no/such.XML").find("no/such.XML: cannot be read"), std::string::npos);
  EXPECT_NE(message("no/such.Obj").find("no/such.Obj"), std::string::npos);
}

}  // namespace
}  // namespace octolux::test
