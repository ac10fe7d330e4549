// display_arguments.h.
#include "tools/display_arguments.h"

#include <CLI/CLI.hpp>

#include "tools/settings.h"

namespace octolux {

void DisplayArguments::add_to(CLI::App& verb, const std::string& what) {
  verb.add_option("--display", options_.display, "Display of " + what)->type_name("NAME");
  verb.add_option("--view", options_.view, "View of " + what)->type_name("NAME");
  verb.add_option("--exposure", exposure_, "Exposure of " + what)
      ->type_name("STOPS")
      ->capture_default_str();
  verb.add_option("--ocio", options_.ocio_config, "OpenColorIO configuration for " + what)
      ->type_name("FILE");
}

DisplayOptions DisplayArguments::options() const {
  DisplayOptions options = options_;
  options.exposure = static_cast<float>(parse_number("--exposure " + exposure_, exposure_));
  return options;
}

}  // namespace octolux
