// Scene files written for one test and loaded again.
#pragma once

#include <fstream>
#include <map>
#include <memory>
#include <string>

#include "core/error.h"
#include "renderer/xml_scene.h"
#include "tests/temporary_folder.h"

namespace octolux::test {

using Defines = std::map<std::string, std::string>;

/// A folder of files; `scene.xml` is the one that is loaded.
class SceneFiles {
 public:
  void write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }

  std::string path(const std::string& name = "scene.xml") const { return folder_ / name; }

  /// Not completed: no ray caster is built.
  std::unique_ptr<Scene> load(const Defines& defines = {}) const {
    auto scene = std::make_unique<Scene>();
    load_xml_scene(path(), {.defines = defines}, *scene);
    return scene;
  }

  /// The message of the Error, or "" if the scene loads.
  std::string error(const Defines& defines = {}) const {
    try {
      load(defines);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }

 private:
  TemporaryFolder folder_;
};

/// `text` as the whole of scene.xml.
inline std::unique_ptr<Scene> load_text(const std::string& text, const Defines& defines = {}) {
  const SceneFiles files;
  files.write("scene.xml", text);
  return files.load(defines);
}

/// What a valid scene needs besides `body`. One line, so that body starts on line 2.
inline std::string scene_with(const std::string& body) {
  return "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"cube\"/>\n" + body +
         "</scene>\n";
}

}  // namespace octolux::test
