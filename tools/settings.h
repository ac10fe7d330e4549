// From text to the settings of a render: `--set key=value` for every setting that config.h's
// visit() lists, and the options that are short names for some of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/config.h"

namespace octolux {

/// An option that stands for a setting.
struct Shortcut {
  const char* option;
  const char* key;
  const char* value;  // as --help shows it
  const char* help;
  bool positive = false;  // 0 would mean "not set", so it cannot be asked for
};
std::span<const Shortcut> shortcuts();

/// Sets `key` from `text`. `source` is what the user typed, for messages. Throws Error for an
/// unknown key or a text that is no value of the setting's type.
void set_setting(RenderConfig& config, const std::string& source, const std::string& key,
                 const std::string& text);

/// The setting's value as text.
std::string get_setting(const RenderConfig& config, const std::string& key);

/// All settings but those `left_out`, with their values, one per line.
std::string list_settings(const RenderConfig& config,
                          const std::vector<std::string>& left_out = {});

/// Throws Error naming `source` unless `text` is a whole number in [lowest, highest].
int parse_int(const std::string& source, const std::string& text, int lowest, int highest);
/// Throws Error naming `source` unless `text` is a finite number.
double parse_number(const std::string& source, const std::string& text);

/// Throws Error for anything but a legal name.
Integrator parse_integrator(const std::string& name);

}  // namespace octolux
