// setting_arguments.h with CLI11.
#include "tools/setting_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "core/error.h"
#include "tools/settings.h"

namespace octolux {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void SettingArguments::add_to(CLI::App& verb, std::vector<std::string> taken) {
  taken_ = std::move(taken);
  for (const Shortcut& shortcut : shortcuts()) {
    if (contains(taken_, shortcut.key)) continue;
    const auto store = [this, &shortcut](const std::string& text) {
      options_.push_back({std::string(shortcut.option) + " " + text, shortcut.key, text});
      if (shortcut.positive && parse_number(options_.back().source, text) <= 0) {
        throw Error(options_.back().source + ": expected a number above 0");
      }
    };
    CLI::Option* option =
        verb.add_option_function<std::string>(shortcut.option, store, shortcut.help);
    option->type_name(shortcut.value);
    if (!shortcut.positive) option->default_str(get_setting(RenderConfig{}, shortcut.key));
  }
  verb.add_option("--set", sets_, "Any setting listed below; repeatable; options win over it")
      ->type_name("key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

RenderConfig SettingArguments::apply(RenderConfig config) const {
  for (const std::string& set : sets_) {
    const auto equals = set.find('=');
    if (equals == std::string::npos) throw Error("--set " + set + ": expected key=value");
    const std::string key = set.substr(0, equals);
    if (contains(taken_, key))
      throw Error("--set " + set + ": not here; --help has what decides it");
    set_setting(config, "--set " + set, key, set.substr(equals + 1));
  }
  for (const Assignment& option : options_) {
    set_setting(config, option.source, option.key, option.text);
  }
  check(config);
  return config;
}

}  // namespace octolux
