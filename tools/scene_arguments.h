// The arguments every verb that reads a scene shares: the file, and -D name=value.
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
  bool skip_missing = false;

  /// The arguments write into this object, so it must stay where it is.
  void add_to(CLI::App& verb);
  /// Throws Error if a definition is malformed or the scene is bad.
  /// Says on `printer` how far it is if that takes long.
  std::unique_ptr<Scene> load(ProgressPrinter& printer) const;
};

}  // namespace octolux
