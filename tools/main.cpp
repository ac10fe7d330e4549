// The command line program: parses arguments and runs a verb. The only place that catches.
// Exit codes: 0 done, 1 a fault of the program, 2 bad input, 130 interrupted.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <vector>

#include "core/error.h"
#include "tools/commands.h"

namespace octolux {
namespace {

constexpr int kFault = 1;
constexpr int kBadInput = 2;
constexpr char kNoCommand[] =
    "no command given; legal: ab, compare, converge, info, lab, render; octolux --help says more";

int complain(const std::string& message, int exit_code) {
  fmt::print(stderr, "octolux: {}\n", message);
  return exit_code;
}

/// The arguments as a shell would take them back.
std::string join_arguments(int argc, char** argv) {
  std::string line = "octolux";
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool plain = !argument.empty() &&
                       argument.find_first_of(" \t\n'\"\\$`*?[]#~&;|<>(){}!") == std::string::npos;
    line += plain ? " " + argument : " '" + argument + "'";
  }
  return line;
}

void check_verb(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  if (argc < 2) throw Error(kNoCommand);
  const std::string first = argv[1];
  if (first.rfind('-', 0) == 0 || std::find(verbs.begin(), verbs.end(), first) != verbs.end()) {
    return;
  }
  throw Error(unknown_name("command", first, verbs));
}

/// What CLI11 could not use, with the option that was probably meant.
std::string unexpected_argument(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  const CLI::App* verb = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  const std::string argument = left.empty() ? "" : left.front();
  if (argument.rfind('-', 0) != 0) return "unexpected argument '" + argument + "'";
  std::vector<std::string> names;
  for (const CLI::Option* option : verb->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string typed = argument.substr(0, argument.find('='));
  const std::string meant = closest_name(typed, names);
  return "unknown option '" + typed + "'" +
         (meant.empty() ? "; see octolux " + (verb == &app ? "" : verb->get_name() + " ") + "--help"
                        : " (did you mean '" + meant + "'?)");
}

int run(int argc, char** argv) {
  CLI::App app("Octolux renders architectural interiors by progressive photon mapping.", "octolux");
  app.set_version_flag("--version", "octolux " OCTOLUX_VERSION, "Print the version and exit");
  app.get_formatter()->column_width(36);
  app.require_subcommand(1);
  app.footer("octolux COMMAND --help lists the options of each.");
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(make_render_command(app, join_arguments(argc, argv)));
  commands.push_back(make_info_command(app));
  commands.push_back(make_lab_command(app));
  commands.push_back(make_compare_command(app));
  commands.push_back(make_ab_command(app, join_arguments(argc, argv)));
  commands.push_back(make_converge_command(app, join_arguments(argc, argv)));
  check_verb(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ExtrasError&) {
    throw Error(unexpected_argument(app));
  } catch (const CLI::RequiredError&) {
    if (app.get_subcommands().empty()) throw Error(kNoCommand);
    throw;
  }
  for (const auto& command : commands) {
    if (command->chosen()) return command->run();
  }
  return kFault;
}

}  // namespace
}  // namespace octolux

int main(int argc, char** argv) {
  using namespace octolux;
  try {
    return run(argc, argv);
  } catch (const Error& e) {
    return complain(e.what(), kBadInput);
  } catch (const CLI::ParseError& e) {
    return complain(e.what(), kBadInput);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", kFault);
  } catch (const std::exception& e) {
    return complain(std::string("internal error: ") + e.what(), kFault);
  }
}
