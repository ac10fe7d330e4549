// Chooses the loader by the file's extension.
#include "renderer/scene_loader.h"

#include <cctype>
#include <filesystem>

#include "core/error.h"
#include "core/hash.h"
#include "renderer/obj_scene.h"
#include "renderer/xml_scene.h"

namespace octolux {
namespace {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

void load_bare_obj(const std::string& path, const LoadOptions& options, Scene& scene) {
  if (!options.defines.empty()) {
    throw Error(path + ": -D " + options.defines.begin()->first +
                ": an .obj file has no parameters");
  }
  if (!options.portals.empty()) {
    throw Error(path + ": --portal " + options.portals.front() +
                ": no light comes from far away in an .obj file");
  }
  load_obj_scene(path, scene);
}

}  // namespace

std::unique_ptr<Scene> load_scene(const std::string& path, const LoadOptions& options) {
  const std::string extension = lower_extension(path);
  auto scene = std::make_unique<Scene>();
  if (extension == ".xml") {
    load_xml_scene(path, options, *scene);
  } else if (extension == ".obj") {
    load_bare_obj(path, options, *scene);
  } else {
    throw Error(path + ": a scene is an .xml (Mitsuba) or .obj (Wavefront) file, not '" +
                extension + "'");
  }
  for (const std::string& portal : options.portals) {
    scene->hash = hash_bytes(scene->hash, portal);
  }
  scene->complete(options.progress);
  return scene;
}

}  // namespace octolux
