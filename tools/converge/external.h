// Other renderers' pictures on the same plot: --add "name=time:file.exr,time:file.exr,...".
#pragma once

#include <string>
#include <vector>

#include "tools/converge/series.h"

namespace octolux {

struct External {
  std::string name;
  /// By time; pictures of one time are different seeds of one point.
  std::vector<std::vector<TimedPicture>> points;
};

/// Throws Error if the text is malformed.
External parse_external(const std::string& text);

/// Throws Error unless every file is a picture of this size with R G B, by its header.
void check_external(const External& external, int width, int height);

}  // namespace octolux
