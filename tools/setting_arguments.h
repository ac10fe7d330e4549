// The arguments that become the settings of a render, the same for every verb that renders:
// --set key=value, and the options that are short for some settings (settings.h).
#pragma once

#include <string>
#include <vector>

#include "renderer/config.h"

namespace CLI {
class App;
}

namespace octolux {

class SettingArguments {
 public:
  /// Adds --set and all short options but those for the settings `taken`, which are then refused:
  /// the verb decides them in its own way. The arguments write into this object, so it must stay
  /// where it is.
  void add_to(CLI::App& verb, std::vector<std::string> taken = {});
  /// `config` with what was typed; options win over --set. Throws Error.
  RenderConfig apply(RenderConfig config) const;

 private:
  /// A setting as it was typed.
  struct Assignment {
    std::string source;  // e.g. "--passes 12"
    std::string key;
    std::string text;
  };

  std::vector<std::string> taken_;
  std::vector<Assignment> options_;
  std::vector<std::string> sets_;
};

}  // namespace octolux
