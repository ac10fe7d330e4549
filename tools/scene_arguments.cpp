// scene_arguments.h with CLI11.
#include "tools/scene_arguments.h"

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "renderer/scene_loader.h"
#include "tools/loading_monitor.h"

namespace octolux {

void SceneArguments::add_to(CLI::App& verb) {
  verb.add_option("SCENE", path, "Mitsuba XML (.xml), or Wavefront OBJ (.obj) with its MTL")
      ->required()
      ->type_name("");
  verb.add_option("-D", defines, "Set the scene file's parameter $name; repeatable")
      ->type_name("name=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.add_flag("--skip-missing", skip_missing,
                "Leave out shapes whose file is missing, with a warning");
}

std::unique_ptr<Scene> SceneArguments::load(ProgressPrinter& printer) const {
  LoadOptions options;
  for (const std::string& define : defines) {
    const auto equals = define.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw Error("-D " + define + ": expected name=value");
    }
    options.defines[define.substr(0, equals)] = define.substr(equals + 1);
  }
  options.skip_missing = skip_missing;
  LoadingMonitor monitor(printer);
  options.progress = monitor.progress();
  return load_scene(path, options);
}

}  // namespace octolux
