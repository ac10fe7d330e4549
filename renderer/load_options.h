// What a caller may say about how a scene is loaded.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/load_progress.h"

namespace octolux {

struct LoadOptions {
  std::map<std::string, std::string> defines = {};  // -D name=value: wins over <default>
  /// Leave out shapes whose file is not there, with a warning, instead of refusing the scene.
  bool skip_missing = false;
  /// Ids of shapes that are portals, besides those that call themselves so.
  std::vector<std::string> portals = {};
  LoadProgress progress = {};
};

}  // namespace octolux
