// The arguments every verb that reads a scene shares: the file, -D name=value, and for those that
// render it the film's size.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "tools/progress.h"

namespace CLI {
class App;
}

namespace octolux {

struct SceneArguments {
  std::string path;
  std::vector<std::string> defines;  // name=value
  std::vector<std::string> portals;  // ids of shapes
  bool skip_missing = false;
  std::string size;  // WIDTHxHEIGHT; "": the scene's own

  /// The arguments write into this object, so it must stay where it is.
  void add_to(CLI::App& verb);
  void add_size_to(CLI::App& verb);
  /// Throws Error if the size is malformed, without reading anything.
  void check() const;
  /// The scene, its film at the size wanted; a crop window keeps its share of it. Throws Error if a
  /// definition or the size is malformed or the scene is bad. Says on `printer` how far it is if
  /// that takes long.
  std::unique_ptr<Scene> load(ProgressPrinter& printer) const;
};

}  // namespace octolux
