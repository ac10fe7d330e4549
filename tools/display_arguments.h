// The options that say how pictures are shown (core/display.h), the same for every verb.
#pragma once

#include <string>

#include "core/display.h"

namespace CLI {
class App;
}

namespace octolux {

class DisplayArguments {
 public:
  /// Adds --display, --view, --exposure and --ocio; `what` is shown through them, e.g. "the PNG".
  void add_to(CLI::App& verb, const std::string& what);
  /// Throws Error unless the exposure is a number; check_display looks at the rest.
  DisplayOptions options() const;

 private:
  DisplayOptions options_;
  std::string exposure_ = "0";
};

}  // namespace octolux
